# For scripts that drive Debian's chromium by playwright-core; they source it with their arguments, [DECK-PROGRAM] [--all] [--times].
# Sets root, all, times, deck, work and chromium, and installs the packages of the viewer's lock file (playwright-core, typescript) in $work. Where
# something cannot be had it says so and ends the script with 0.
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
all=no times=no deck=$root/build/dev/tools/deck
for argument in "$@"; do
  case "$argument" in --all) all=yes ;; --times) times=yes ;; *) deck=$argument ;; esac
done
deck=$(realpath -m "$deck")
work=$root/build/browser
export DECK_ARTEFACTS=${DECK_ARTEFACTS:-$root/build/$artefacts/artefacts} DECK_CORPUS=${DECK_CORPUS:-$root/../shared}
skip() {
  echo "skipped  $1"
  echo "0 passed, 0 failed, 1 skipped"
  exit 0
}
[ -x "$deck" ] || { echo "$deck: no such program; build the target 'deck' first" >&2; exit 2; }
chromium=${CHROMIUM:-$(command -v chromium || command -v chromium-browser || true)}
[ -n "$chromium" ] || skip "no chromium (Debian: apt-get install chromium)"
command -v npm >/dev/null && command -v node >/dev/null || skip "no npm"
mkdir -p "$work" "$DECK_ARTEFACTS"
stamp=$work/installed-$(sha256sum "$root/tools/viewer/package-lock.json" | cut -c1-16)
if [ ! -e "$stamp" ]; then
  cp "$root/tools/viewer/package.json" "$root/tools/viewer/package-lock.json" "$work/"
  (cd "$work" && npm ci --ignore-scripts --no-audit --no-fund) >"$work/npm.log" 2>&1 ||
    skip "npm ci failed: $(tail -n 1 "$work/npm.log")"
  touch "$stamp"
fi
