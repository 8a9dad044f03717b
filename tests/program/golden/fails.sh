#!/bin/bash
# fails.sh FLANEUR: golden.sh sees a run that goes otherwise from some tick on, and names the second and what to do.
set -euo pipefail
folder=$(cd "$(dirname "$0")" && pwd)
cat > "$TMPDIR/parts" << END
#!/bin/bash
exec "$1" "\$@" | awk '\$1 >= 401 { \$2 = "0" \$2 } { print }'
END
chmod +x "$TMPDIR/parts"
"$folder/golden.sh" "$1" corner --threads 1
if said=$("$folder/golden.sh" "$TMPDIR/parts" corner --threads 1); then echo "FAILED: another run passes." && exit 1; fi
echo "$said"
grep --quiet "^FAILED: corner is another from second 7 of 20 on: its hash is \"0" <<< "$said"
grep --quiet "check --sim --with FLANEUR_BEFORE --scene corner --walkers 40 --seconds 7 --threads 1$" <<< "$said"
