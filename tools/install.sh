#!/bin/sh
# install.sh install|uninstall - puts what make has built, and the texts of the tree, into BINDIR, LIBDIR,
# INCLUDEDIR, DATADIR, MANDIR and DOCDIR, all below DESTDIR; or removes exactly these files, and the
# directories below PREFIX that are empty then.  make calls it and sets these variables, BUILD,
# VERSION and SONAME.
set -e
action=$1
PREFIX=${PREFIX%/}

# A path as dalembert.pc has it.
from_prefix() { # PATH
    case $1 in
    "$PREFIX"/*) printf '${prefix}/%s' "${1#"$PREFIX"/}" ;;
    *) printf '%s' "$1" ;;
    esac
}
# PREFIX itself stays, and so does what is in /usr or /usr/local on every system.
remove_empty() { # DIRECTORY
    empty=$1
    while [ "$empty" != "$PREFIX" ] && [ "$empty" != / ]; do
        case $DESTDIR$empty in
        */dalembert | */dalembert/*) ;;
        /usr/*) return 0 ;;
        esac
        rmdir "$DESTDIR$empty" 2>/dev/null || return 0
        empty=$(dirname "$empty")
    done
}

case $action in
install)
    files() { # MODE DIRECTORY FILE...
        mode=$1 to=$DESTDIR$2
        shift 2
        echo "  install $to"
        install -d "$to"
        install -m "$mode" "$@" "$to"
    }
    link() { ln -sf "$1" "$DESTDIR$2"; } # TARGET FILE
    template() {                         # DIRECTORY FILE: filled in from tools/FILE.in
        echo "  install $DESTDIR$1"
        install -d "$DESTDIR$1"
        sed "s|@VERSION@|$VERSION|; s|@SONAME@|$SONAME|; s|@PREFIX@|$PREFIX|
            s|@LIBDIR@|$LIBDIR|; s|@FROM_PREFIX_LIBDIR@|$(from_prefix "$LIBDIR")|
            s|@INCLUDEDIR@|$INCLUDEDIR|; s|@FROM_PREFIX_INCLUDEDIR@|$(from_prefix "$INCLUDEDIR")|" \
            "tools/$2.in" >"$DESTDIR$1/$2"
        chmod 644 "$DESTDIR$1/$2"
    }
    ;;
uninstall)
    files() {
        from=$2
        shift 2
        for file; do rm -f "$DESTDIR$from/${file##*/}"; done
        remove_empty "$from"
    }
    link() { rm -f "$DESTDIR$2"; }
    template() { files 644 "$@"; }
    ;;
*)
    echo "usage: install.sh install|uninstall" >&2
    exit 2
    ;;
esac

files 755 "$BINDIR" "$BUILD/dalembert"
if [ $action = uninstall ] || [ -e "$BUILD/dalembert-mpi" ]; then
    files 755 "$BINDIR" "$BUILD/dalembert-mpi"
fi
files 644 "$LIBDIR" "$BUILD/libdalembert.a" "$BUILD/libdalembert.so.$VERSION"
link "libdalembert.so.$VERSION" "$LIBDIR/$SONAME"
link "$SONAME" "$LIBDIR/libdalembert.so"
template "$LIBDIR/pkgconfig" dalembert.pc
template "$LIBDIR/cmake/dalembert" dalembert-config.cmake
template "$LIBDIR/cmake/dalembert" dalembert-config-version.cmake

# The kernel's header is made from lib/kernel; dalembert_program.h is the program's own.
for header in include/*.h; do
    case $header in
    *_kernel.h) files 644 "$INCLUDEDIR" "$BUILD/generated/dalembert_kernel.h" ;;
    *_program.h) ;;
    *) files 644 "$INCLUDEDIR" "$header" ;;
    esac
done
files 644 "$MANDIR/man1" "$BUILD/dalembert.1"
files 644 "$DATADIR/bash-completion/completions" "$BUILD/dalembert.bash"
files 644 "$DATADIR/dalembert/systems" systems/*.yaml
files 644 "$DATADIR/dalembert/studies" bench/studies/*.yaml
files 644 "$DOCDIR" README.md CHANGELOG.md CONTRIBUTING.md CITATION.cff LICENSE
files 644 "$DOCDIR/docs" docs/*.md
files 644 "$DOCDIR/docs/gallery" docs/gallery/*
files 644 "$DOCDIR/examples" examples/*.[ch] examples/*.cpp examples/*.yaml examples/*.csv examples/CMakeLists.txt
