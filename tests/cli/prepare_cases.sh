# tools/prepare.sh waits for another apt, and for that alone; it installs the library of charts once, and no other bytes.

mkdir -p apt/bin
printf '#!/bin/sh\nexit 1\n' >apt/bin/dpkg-query # nothing is installed
printf '#!/bin/sh\nexec "$@"\n' >apt/bin/sudo
printf '#!/bin/sh\necho slept >>apt/log\n' >apt/bin/sleep
cat >apt/bin/apt-get <<'APT'
#!/bin/sh
echo "apt-get $*" >>apt/log
case $* in *update*) ;; *) exit 0 ;; esac
[ "$(grep -c update apt/log)" -gt 2 ] && exit 0
cat apt/fault >&2
exit 100
APT
chmod +x apt/bin/*
# A registry whose package has the right checksum where there is a file `right`.
cat >apt/bin/npm <<'NPM'
#!/bin/sh
echo "npm $*" >>"$REGISTRY/log"
[ -e "$REGISTRY/package.tgz" ] && cp "$REGISTRY/package.tgz" uplot-1.6.32.tgz
NPM
cat >apt/bin/wget <<'WGET'
#!/bin/sh
echo "wget $*" >>"$REGISTRY/log"
while [ $# -gt 1 ] && [ "$1" != -O ]; do shift; done
[ -e "$REGISTRY/elsewhere.tgz" ] && cp "$REGISTRY/elsewhere.tgz" "$2"
WGET
printf '#!/bin/sh\ncat >/dev/null\n[ -e "$REGISTRY/right" ]\n' >apt/bin/sha256sum
chmod +x apt/bin/npm apt/bin/wget apt/bin/sha256sum
mkdir -p apt/package/dist
for part in dist/uPlot.iife.min.js dist/uPlot.min.css LICENSE; do echo "$part" >apt/package/$part; done
tar -czf apt/package.tgz -C apt package
touch apt/right
prepares() {
    PATH="$work/apt/bin:$PATH" REGISTRY=$work/apt DALEMBERT_UPLOT=$work/apt/uplot \
        sh "$here/../../tools/prepare.sh" "$@" >out 2>err
}

case_is "another apt is running"
echo 'E: Could not get lock /var/lib/apt/lists/lock. It is held by process 1 (apt-get)' >apt/fault
expect "it fails" prepares
expect "updates" [ "$(grep -c update apt/log)" -eq 3 -a "$(grep -c slept apt/log)" -eq 2 ]
expect "the lock of dpkg" grep -q 'DPkg::Lock::Timeout=[1-9][0-9]* install -y' apt/log

case_is "apt that fails otherwise"
rm apt/log
echo 'E: The repository does not have a Release file.' >apt/fault
refute "it succeeds" prepares
expect "updates" [ "$(grep -c update apt/log)" -eq 1 ]
says 'does not have a Release file'

case_is "the library of charts"
rm -rf apt/uplot apt/log
expect "it fails" prepares charts
expect "other files" test "$(cat apt/uplot/uPlot.iife.min.js apt/uplot/uPlot.min.css apt/uplot/LICENSE)" = \
    "$(cd apt/package && cat dist/uPlot.iife.min.js dist/uPlot.min.css LICENSE)"
expect "no version" grep -qx 'npm pack --silent uplot@1\.6\.32' apt/log
rm apt/log
expect "it fails the second time" prepares charts
refute "it downloads a second time, or calls apt" test -e apt/log
case_is "the library of charts where npm fails"
rm -r apt/uplot
mv apt/package.tgz apt/elsewhere.tgz
expect "it fails" prepares charts
expect "neither npm nor wget is called" [ "$(cut -d " " -f 1 apt/log | tr "\n" " ")" = "npm wget " ]
mv apt/elsewhere.tgz apt/package.tgz

case_is "the library of charts is not there, or another"
rm -r apt/right apt/uplot
refute "other bytes are installed" prepares charts
says 'uplot@1\.6\.32 has another checksum than [0-9a-f]+$'
refute "other bytes are there" test -e apt/uplot
rm apt/package.tgz
refute "nothing is installed" prepares charts
says 'cannot download uplot@1\.6\.32$'
printf '#!/bin/sh\nexit 0\n' >apt/bin/apt-get
prepares_in() { (export CI="$1"; prepares lint); }
expect "the rest is not installed" prepares_in ""
says 'tables without charts; later: sh tools/prepare\.sh charts$'
refute "the continuous check goes on without charts" prepares_in true
rm -rf apt
