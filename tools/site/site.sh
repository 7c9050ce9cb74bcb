#!/bin/sh
# site.sh BUILD - makes BUILD/site from docs/ (mkdocs) and from the public headers (Doxygen), and
# follows every link in it.  A warning of a tool, an undocumented declaration or a broken link fails.
# BUILD/dalembert makes the families of methods and the gallery; KaTeX typesets equations.
cd "$(dirname "$0")/../.." || exit 2
pages=$1/pages site=$1/site

missing=
for tool in mkdocs doxygen; do
    command -v $tool >/dev/null || missing="$missing $tool"
done
mkdocs build --help 2>/dev/null | grep -q '[[|]material[]|]' || missing="$missing mkdocs-material"
if [ -n "$missing" ]; then
    echo "make docs needs$missing: sudo apt-get install --no-install-recommends$missing" >&2
    exit 1
fi
# left_out WHAT REASON: the site has less; in the continuous check that fails.
left_out() {
    echo "make docs: without $2, $1" >&2
    [ "${CI:-}" != true ] || exit 1
}
[ -x "$1/dalembert" ] || left_out "families of methods and gallery are left out" "the program ('make')"
python3 -c 'import sys; sys.path.insert(0, "tools/site"); import mathematics; sys.exit(not mathematics.can_typeset())' ||
    left_out "equations stay LaTeX" "katex"

logged() { "$@" >"$pages.log" 2>&1 || { cat "$pages.log" >&2; exit 1; }; }

rm -rf "$pages" "$site"
mkdir -p "$pages" || exit 1
export PAGES="$pages"
for header in include/*.h; do # where its filter fails Doxygen continues with an empty file
    python3 tools/site/headers.py "$header" >/dev/null || exit 1
done
doxygen tools/site/Doxyfile >/dev/null || exit 1
python3 tools/site/pages.py "$pages" "$1/dalembert" || exit 1
logged mkdocs build --config-file "$pages.yml" --site-dir "$(realpath "$pages/..")/site"

python3 tools/site/mathematics.py "$pages.formulas" "$site" || exit 1

logged python3 tools/site/links.py "$site"
echo "$site/index.html"
