"""The example's notebook, run without a screen: of the recording where the corpus is here, and of a file that it writes."""

import base64
import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

NOTEBOOK = Path(__file__).resolve().parents[2] / "examples" / "notebook" / "density.ipynb"
SHARED = Path(os.environ.get("FLANEUR_SHARED", "/nowhere"))
for module in ("nbconvert", "ipykernel", "matplotlib"):
    pytest.importorskip(module, reason=f"there is no {module}: tools/packages test installs it")
if not shutil.which("ffmpeg"):
    pytest.skip("there is no ffmpeg", allow_module_level=True)


def outputs_of(notebook):
    for cell in notebook["cells"]:
        for output in cell.get("outputs", ()):
            assert output["output_type"] != "error", output
            assert output.get("name") != "stderr", output
            yield output.get("data", {})


@pytest.mark.parametrize("shared", [SHARED, Path("/nowhere")], ids=["recorded", "written"])
def test_it_runs_and_shows_pictures(shared, tmp_path):
    if shared == SHARED and not (SHARED / "corpus").is_dir():
        pytest.skip("the corpus of trajectories is not here")
    shutil.copy(NOTEBOOK, tmp_path)
    env = {**os.environ, "FLANEUR_SHARED": str(shared), "JUPYTER_PLATFORM_DIRS": "1", "HOME": str(tmp_path)}
    env.pop("MPLBACKEND", None)  # as a notebook has it
    done = subprocess.run(
        [sys.executable, "-m", "nbconvert", "--to", "notebook", "--execute", "--inplace", NOTEBOOK.name],
        cwd=tmp_path, env=env, capture_output=True, text=True, timeout=500,
    )
    assert done.returncode == 0, done.stderr[-3000:]
    outputs = list(outputs_of(json.loads((tmp_path / NOTEBOOK.name).read_text())))
    pictures = [base64.b64decode(o["image/png"]) for o in outputs if "image/png" in o]
    assert len(pictures) == 6 and all(len(p) > 5000 for p in pictures)
    films = ["".join(o["text/html"]) for o in outputs if "text/html" in o and "<video" in "".join(o["text/html"])]
    assert len(films) == 1 and len(films[0]) > 50_000
    kept = os.environ.get("FLANEUR_KEEP_PICTURES")  # a folder to look at them in
    if kept:
        for number, picture in enumerate(pictures):
            (Path(kept) / f"{shared.name}-{number}.png").write_bytes(picture)
        (Path(kept) / f"{shared.name}.mp4").write_bytes(base64.b64decode(films[0].split("base64,")[1].split('"')[0]))


def test_it_is_kept_without_outputs_in_ten_cells():
    cells = json.loads(NOTEBOOK.read_text())["cells"]
    assert len(cells) == 10 and not any(cell.get("outputs") or cell.get("execution_count") for cell in cells)
