#!/bin/bash
# trace_svg.sh ROOT: tools/trace_svg draws a small trace, zones within zones, and refuses by a sentence what is none.
set -euo pipefail
draw=$(realpath "$1")/tools/trace_svg
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
cat > trace.json << 'END'
{"displayTimeUnit": "ms", "otherData": {}, "traceEvents": [
{"name": "thread_name", "ph": "M", "pid": 1, "tid": 1, "args": {"name": "main"}},
{"name": "thread_name", "ph": "M", "pid": 1, "tid": 3, "args": {"name": "worker <1>"}},
{"name": "frame", "ph": "X", "pid": 1, "tid": 1, "ts": 1000, "dur": 10000},
{"name": "a & b", "ph": "X", "pid": 1, "tid": 1, "ts": 2000, "dur": 4000},
{"name": "frame", "ph": "X", "pid": 1, "tid": 1, "ts": 20000, "dur": 2500},
{"name": "wait for work", "ph": "X", "pid": 1, "tid": 3, "ts": 1000, "dur": 5000},
{"name": "steer", "ph": "X", "pid": 1, "tid": 3, "ts": 6000, "dur": 3000},
{"name": "draws", "ph": "C", "pid": 1, "tid": 1, "ts": 1500, "args": {"value": 7}},
{"name": "paths due", "ph": "C", "pid": 1, "tid": 1, "ts": 1500, "args": {"value": 1}},
{"name": "paths due", "ph": "C", "pid": 1, "tid": 1, "ts": 4500, "args": {"value": 4}}]}
END
failed() { echo "FAILED: $*" && exit 1; }
has() { grep --quiet -F -- "$2" "$1" || failed "$1 has no $2"; }
"$draw" trace.json --title '<two>' > slowest.svg
python3 -c 'import sys, xml.dom.minidom; xml.dom.minidom.parse(sys.argv[1])' slowest.svg
# The frame is 10 ms over 894 pixels; what lies in it begins 1 ms later, a row below.
for piece in '&lt;two&gt;' 'worker &lt;1&gt;' 'x="92.0" y="78" width="894.0"' 'x="181.4" y="95" width="357.6"' '>frame 10.00<' \
    '>a &amp; b 4.00<' '<title>steer, 3.00 ms' 'class="wait"' '>draws: 7<' 'paths due, up to 4'; do
    has slowest.svg "$piece"
done
"$draw" trace.json --frame 1 > second.svg
has second.svg 'frame 2.50'
! grep --quiet worker second.svg || failed "a row for a thread that did nothing"
"$draw" trace.json --from 5 --to 9 > part.svg
has part.svg '4.00 ms'
refused() {  # SENTENCE ARGUMENT...
    local status=0
    "$draw" "${@:2}" > out 2> said || status=$?
    ((status == 1)) || failed "status $status of $*"
    [[ $(wc -l < said) == 1 && ! -s out ]] || failed "$* says $(cat said out)"
    has said "$1"
}
echo '{"a": [1' > broken.json
echo '[1, 2]' > list.json
echo '{"traceEvents": [3]}' > events.json
echo '{"traceEvents": []}' > empty.json
echo '{"traceEvents": [{"name": "a", "ph": "X", "tid": 1, "ts": "x", "dur": 3}]}' > no_time.json
sed 's/"frame"/"other"/' trace.json > no_frames.json
head -c 300 /dev/urandom > noise.json
refused 'cannot be read: No such file' nowhere.json
refused 'is no JSON' broken.json
refused 'is no JSON' noise.json
refused 'has no traceEvents' list.json
refused 'has no traceEvents' events.json
refused 'has no zones' empty.json
refused 'at no time' no_time.json
refused 'say which stretch' no_frames.json
refused '--frame 2 is neither' trace.json --frame 2
refused 'is not before' trace.json --from 9 --to 5
refused 'there is nothing from 50' trace.json --from 50 --to 60
