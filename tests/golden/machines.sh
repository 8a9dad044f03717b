#!/bin/bash
# machines.sh RENDERCHECK FLANEUR SUITE: pictures blessed here pass on a CPU without AVX2, without AVX, and with one
# thread. The references are this machine's own, so that this holds for any driver.
set -euo pipefail
rendercheck=$1 flaneur=$2 suite=$3
[[ $("$rendercheck" device) == *llvmpipe* ]] || { echo "SKIPPED: there is no llvmpipe here." && exit 77; }
cases=scene_district,scene_asteroid,quality_high,weather_clear_night
sed "s|{suite}/../program|$(dirname "$suite")/../program|g" "$suite" > "$TMPDIR/suite.json"
check() { "$rendercheck" run "$TMPDIR/suite.json" --program "flaneur=$flaneur" --filter "$cases" "$@"; }
check --bless > "$TMPDIR/log" || { cat "$TMPDIR/log" && exit 1; }
# Compiled shaders are kept for each CPU apart, and here made anew.
export MESA_SHADER_CACHE_DIR=$TMPDIR/shaders
for machine in GALLIUM_OVERRIDE_CPU_CAPS=avx GALLIUM_OVERRIDE_CPU_CAPS=sse4.1 LP_NUM_THREADS=1; do
    echo "$machine"
    rm -rf "$MESA_SHADER_CACHE_DIR"
    (export "${machine?}" && check)
done
sed -i 's|"--frames"|"--threads", "1", "--frames"|' "$TMPDIR/suite.json"
echo "one thread of the simulation" && check
