# tools/prepare.sh waits for another apt, and for that alone.

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
prepares() { PATH="$work/apt/bin:$PATH" sh "$here/../../tools/prepare.sh" >out 2>err; }

case_is "another apt is running"
echo 'E: Could not get lock /var/lib/apt/lists/lock. It is held by process 1 (apt-get)' >apt/fault
expect "it fails" prepares
expect "updates" [ "$(grep -c update apt/log)" -eq 3 -a "$(grep -c slept apt/log)" -eq 2 ]
expect "the lock of dpkg" grep -q 'DPkg::Lock::Timeout=[1-9][0-9]* install -y' apt/log

case_is "apt that fails otherwise"
rm apt/log
echo 'E: The repository does not have a Release file.' >apt/fault
refute "it succeeds" env PATH="$work/apt/bin:$PATH" sh "$here/../../tools/prepare.sh"
expect "updates" [ "$(grep -c update apt/log)" -eq 1 ]
prepares
says 'does not have a Release file'
rm -rf apt
