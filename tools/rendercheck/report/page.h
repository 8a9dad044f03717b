// The page around the pictures: looks, and what the wheel, the slider and the keys do.
#pragma once

namespace flaneur {

inline constexpr const char* k_page_head = R"(<!doctype html>
<html lang="en"><head><meta charset="utf-8"><title>Render checks</title>
<meta name="viewport" content="width=device-width">
<style>
:root { color-scheme: light dark; --line: #8886; --bad: #c8321e; --accent: #2a7de1; }
* { box-sizing: border-box; }
body { font: 15px/1.45 system-ui, sans-serif; margin: 0 auto; padding: 1.2rem; max-width: 110rem; }
header p, .name { opacity: .75; }
h1 { font-size: 1.4rem; margin: 0; }
h2 { font-size: 1.1rem; margin: 0 0 .3rem; }
.case { border-top: 1px solid var(--line); padding: 1rem 0; }
.status { background: var(--bad); color: #fff; font-size: .75rem; padding: .15rem .45rem; border-radius: .25rem; vertical-align: 2px; }
ul { margin: .3rem 0 .6rem; padding-left: 1.2rem; }
.passed { columns: 14rem; }
.row { display: grid; grid-template-columns: repeat(auto-fill, minmax(min(100%, 26rem), 1fr)); gap: .7rem; }
figure { margin: 0; }
figcaption { font-size: .8rem; opacity: .75; }
.frame { position: relative; overflow: hidden; aspect-ratio: var(--w) / var(--h); background: #0003; cursor: grab; touch-action: none; }
.frame img { position: absolute; width: 100%; transform-origin: 0 0; image-rendering: pixelated; user-select: none; -webkit-user-drag: none; }
.both .bar { position: absolute; top: 0; bottom: 0; width: 2px; margin-left: -1px; background: var(--accent); }
.tools { display: flex; flex-wrap: wrap; gap: 1rem; align-items: center; margin: .3rem 0; }
pre { overflow-x: auto; background: #8882; padding: .5rem; margin: .2rem 0 .6rem; white-space: pre-wrap; }
</style></head><body>
)";

inline constexpr const char* k_page_end = R"(<script>
for (const set of document.querySelectorAll(".set")) {
  const fresh = set.querySelector(".new img"), before = set.querySelector(".reference img");
  const both = set.querySelector(".both .frame"), slide = set.querySelector(".slide"), blink = set.querySelector(".blink");
  const boxes = JSON.parse(set.querySelector(".boxes")?.textContent ?? "[]");
  const style = getComputedStyle(set), width = +style.getPropertyValue("--w"), height = +style.getPropertyValue("--h");
  let top = null, bar = null, shown = true, timer = 0, zoom = 1, x = 0, y = 0;
  if (both) {
    both.append(before.cloneNode(), top = fresh.cloneNode(), bar = document.createElement("div"));
    bar.className = "bar";
  }
  // x and y: the point of the picture at the upper left corner, as shares.
  const show = () => {
    x = Math.min(Math.max(x, 0), 1 - 1 / zoom), y = Math.min(Math.max(y, 0), 1 - 1 / zoom);
    for (const img of set.querySelectorAll("img"))
      img.style.transform = `scale(${zoom}) translate(${-x * 100}%, ${-y * 100}%)`;
    if (!both) return;
    const share = slide.value / 100;
    top.style.visibility = shown ? "visible" : "hidden";
    top.style.clipPath = blink.checked ? "none" : `inset(0 ${100 * (1 - (x + share / zoom))}% 0 0)`;
    bar.style.left = share * 100 + "%";
    bar.style.display = blink.checked ? "none" : "block";
  };
  const at_box = ([left, upper, across, down]) => {
    zoom = Math.min(Math.max(.4 / Math.max(across / width, down / height), 1), 16);
    x = (left + across / 2) / width - .5 / zoom, y = (upper + down / 2) / height - .5 / zoom;
    show();
  };
  for (const frame of set.querySelectorAll(".frame")) {
    frame.addEventListener("wheel", event => {
      event.preventDefault();
      const r = frame.getBoundingClientRect(), u = (event.clientX - r.left) / r.width, v = (event.clientY - r.top) / r.height;
      const next = Math.min(Math.max(zoom * Math.exp(-event.deltaY / 300), 1), 64);
      x += u / zoom - u / next, y += v / zoom - v / next, zoom = next;
      show();
    }, {passive: false});
    frame.addEventListener("pointerdown", event => frame.setPointerCapture(event.pointerId));
    frame.addEventListener("pointermove", event => {
      const r = frame.getBoundingClientRect();
      const px = Math.floor((x + (event.clientX - r.left) / r.width / zoom) * width);
      const py = Math.floor((y + (event.clientY - r.top) / r.height / zoom) * height);
      const told = set.querySelector(".at");
      if (told) told.textContent = `${px}, ${py}`;
      if (!event.buttons) return;
      x -= event.movementX / r.width / zoom, y -= event.movementY / r.height / zoom;
      show();
    });
  }
  slide?.addEventListener("input", show);
  const blinking = () => {
    clearInterval(timer);
    shown = true;
    if (blink.checked) timer = setInterval(() => { shown = !shown; show(); }, 400);
    show();
  };
  blink?.addEventListener("change", blinking);
  set.querySelector(".fit")?.addEventListener("click", () => { zoom = 1, x = y = 0, show(); });
  set.addEventListener("pointerenter", () => window.current = set);
  set.go = event => {
    if (event.key === "b" && blink) blink.checked = !blink.checked, blinking();
    const box = boxes[+event.key - 1];
    if (box) at_box(box);
  };
  window.current ??= set;
  show();
}
addEventListener("keydown", event => { if (!event.ctrlKey && !event.metaKey) window.current?.go(event); });
</script></body></html>
)";

}  // namespace flaneur
