#!/bin/bash
# sim_check.sh FLANEUR: `flaneur check --sim` finds runs equal that are, and of others the tick, the walker and the field.
set -euo pipefail
export FLANEUR=$1
here=$(cd "$(dirname "$0")" && pwd)
cd "$TMPDIR"
corner=(--scene corner --walkers 24 --seconds 2)
fail() { echo "FAILED: $*" && cat out err && exit 1; }
# parts WORDS...: it ends with 1, and says what differs.
parts() {
    local status=0
    "$FLANEUR" check --sim "$@" > out 2> err || status=$?
    ((status == 1)) || fail "ended with $status: $*"
}
says() { grep --quiet -E -- "$1" out err || fail "not said: $1"; }

# What is equal: other threads, other instruction sets, another program, a log.
sentence=$("$FLANEUR" sim --isa none 2>&1) || true
sets=$(sed -E 's/.* it has ([a-z0-9, ]+) and best.*/\1/; s/,//g' <<< "$sentence")
others=("--threads 1" "--threads 3")
for isa in $sets; do others+=("--isa $isa --threads 2"); done
for options in "${others[@]}"; do
    "$FLANEUR" check --sim --with-options "$options" "${corner[@]}" > out 2> err || fail "$options"
    says "All 121 states are equal, from tick 0 to 120: 24 walkers"
done
"$FLANEUR" check --sim --with "$FLANEUR" "${corner[@]}" > out 2> err || fail "two of the same"
"$FLANEUR" check --sim --with "$FLANEUR" --scene asteroid --walkers 10 --seconds 1 > out 2> err || fail "asteroid"
"$FLANEUR" sim "${corner[@]}" --seed 5 --threads 3 --state-log a.log --hash > hash
"$FLANEUR" check --sim --against a.log > out 2> err || fail "its own log"
says "All 121 states"
"$FLANEUR" check --sim --against a.log --threads 1 --seconds 1 > out 2> err || fail "half of a log"
says "All 61 states"
"$FLANEUR" sim "${corner[@]}" --seed 5 --state-log - 2> err | cmp - a.log
head -c -4 a.log > cut.log
[[ $("$FLANEUR" sim "${corner[@]}" --seed 5 --hash 2> err) == $(cat hash) ]] || fail "a log changes the run"

# Another seed: from the beginning.
parts --with-options "--seed 2" "${corner[@]}"
says "^flaneur: The two part at tick 0: walker [0-9]+, (person|who)\."
says "^There [0-9]+ of 24 walkers differ"
# One walker's one field from some tick on, of another program and of a log.
export TICK=77 DISTURB=13:gait.left.phase
parts --with "$here/disturbed" "${corner[@]}"
says "^flaneur: The two part at tick 77: walker 13, gait.left.phase\.$"
says "^The first difference is after tick 77, at 1.283 s: walker 13, gait.left.phase\.$"
says "^There 1 of 24 walkers differ, and 1 of [0-9]+ fields:$"
says "^  gait.left.phase +1 +13 +[-0-9.e]+ +0.25$"
says "^Walker 13 here is a (wo)?man of [0-9]+, "
says "flaneur render --scene corner --walkers 24 --camera follow:13 --frames 77 --out tick77.png"
"$here/disturbed" sim "${corner[@]}" --state-log - > far.log 2> err
parts --against far.log
says "at tick 77: walker 13, gait.left.phase"
says "^  gait.left.phase +1 +13 +\? +\?$"
says "flaneur sim --scene corner --walkers 24 --seconds 1.2833 --state-log tick.log"
# Whoever asks for another world is told that it is one, and not sent for values of it.
parts --against a.log --seed 7 && says "not the world of the log, but with --seed 7"
if grep --quiet tick.log out err; then fail "values of another world are advised"; fi
"$here/disturbed" sim "${corner[@]}" --seconds 1.2833 --state-log - > near.log 2> err
parts --against near.log
says "^  gait.left.phase +1 +13 +[-0-9.e]+ +0.25$"

# What is no other side.
damaged="The state log bad.log is damaged: copy it again"
cp cut.log bad.log && parts --against bad.log && says "$damaged"
(cat a.log && echo) > bad.log && parts --against bad.log && says "$damaged"
for at in 25 100 20000 $(($(stat -c %s a.log) - 3)); do
    cp a.log bad.log
    printf '\xa5' | dd of=bad.log bs=1 seek="$at" conv=notrunc status=none
    parts --against bad.log && says "$damaged"
    parts --against bad.log --seconds 0 && says "$damaged"
done
cat > flips << 'END'
#!/bin/bash
"$FLANEUR" "$@" | head -c -1
printf '\xa5'
END
chmod +x flips
parts --with ./flips "${corner[@]}" && says "The state log ./flips is damaged"
parts --against "$here/disturbed" && says "is no state log that can be read, for it begins otherwise"
parts --with /bin/true "${corner[@]}"
says "/bin/true is no flaneur that knows .sim --state-log.: it ended with exit code 0 and wrote no log"
parts --with /bin/ls "${corner[@]}" && says "The other side failed: /bin/ls ended with exit code 2\. It said: .*ls"
parts --with-options "--isa neon" "${corner[@]}" && says "failed: this program, with --isa neon, ended with exit code 1"
says "It said: .*neon"
cat > dies << 'END'
#!/bin/bash
printf 'one\nlast words\n\n' >&2
kill -SEGV $$
END
chmod +x dies
parts --with ./dies "${corner[@]}" && says "failed: ./dies ended by SIGSEGV. It said: one / last words$"
cat > dies_late << 'END'
#!/bin/bash
"$FLANEUR" "$@" 2> /dev/null | head -c 30000
echo late >&2
exit 3
END
chmod +x dies_late
parts --with ./dies_late "${corner[@]}" && says "failed: ./dies_late ended with exit code 3. It said: late$"
parts --with-options "--bogus" "${corner[@]}" && says "failed: this program, with --bogus, ended with .* It said: flaneur: .*--bogus"
parts --with-options "--walkers 23" "${corner[@]}" && says "room for 24 walkers here and for 23 there"
sed '0,/^word --walkers$/s//word --trace/' a.log > bad.log
"$here/summed" bad.log
parts --against bad.log && says "no world's" && [[ ! -e 24 ]]

# Ended, it ends the other one too.
rm -f id
cat > sleeps << 'END'
#!/bin/bash
echo $$ > id
sleep 1000
END
chmod +x sleeps
env --default-signal=INT "$FLANEUR" check --sim --with ./sleeps "${corner[@]}" > out 2> err &
check=$!
for _ in $(seq 200); do if [[ -s id ]]; then break; fi; sleep 0.05; done
kill -INT $check
status=0
wait $check || status=$?
((status == 130)) || fail "ended with $status by SIGINT"
if kill -0 "$(cat id)" 2> /dev/null; then fail "the other one goes on"; fi
