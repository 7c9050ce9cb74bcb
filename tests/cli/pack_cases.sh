# dalembert pack: what is unpacked makes the same results again.

case_is "pack: a run, made again from its archive"
try 0 run falling-disk --integrator gauss4+project --time 1 --step 0.05 --set m=1.2345678901234567 --samples 7 --observe "theta^2" -o disk
try 0 pack disk
says "packed 2 files into 'disk\.tar'"
mkdir unpacked
expect "tar" tar xf disk.tar -C unpacked
expect "rows without --all" test ! -e unpacked/disk/trajectory.npy
expect "the built-in system" test -s unpacked/disk/builtin/falling-disk.yaml
try 0 show falling-disk
expect "another file of the system" cmp -s out unpacked/disk/builtin/falling-disk.yaml
command=$(sed -n 's/^ *dalembert run //p' unpacked/disk/README.txt)
(cd unpacked && eval "'$program' run $command" >/dev/null 2>&1)
expect "other rows: $command" cmp -s disk/trajectory.npy unpacked/again/trajectory.npy

case_is "pack: a run of a file, whose name and values need quotes"
cat >"a file.yaml" <<'END'
coordinates: [x]
parameters: {k: 4}
lagrangian: x'^2/2 - k*x^2/2
start: {x: 1}
END
try 0 run "a file.yaml" --integrator rk4 --time 2 --step 0.1 --set k=2.25 --start "x'=0.5" --observe "x^2 + x'^2" -o "of file"
try 0 pack "of file" -o file.tar
expect "tar" tar xf file.tar -C unpacked
command=$(sed -n 's/^ *dalembert run //p' "unpacked/of file/README.txt" | sed 's/ --output .*//')
(cd "unpacked/of file" && eval "'$program' run $command -o again" >/dev/null 2>&1)
expect "other rows: $command" cmp -s "of file/trajectory.npy" "unpacked/of file/again/trajectory.npy"

case_is "pack: a study, made again from its archive"
cat >pair.yaml <<'END'
title: A pair
systems: [damped-oscillator, ./a file.yaml]
integrators: [rk4, gauss4]
step: 0.1
time: 1
END
try 0 study pair.yaml -o pair --no-page
try 0 pack pair
expect "the system that is built in" test "$(tar tf pair.tar | grep -c builtin/damped-oscillator.yaml)" -eq 1
expect "tar" tar xf pair.tar -C unpacked
expect "a page, rows or a lock" test -z "$(find unpacked/pair -name '*.npy' -o -name report -o -name lock)"
(cd unpacked/pair && "$program" study study.yaml -o again --no-page >/dev/null 2>&1)
expect "other tables" cmp -s pair/tables.txt unpacked/pair/again/tables.txt

case_is "pack: a study of a system elsewhere"
mkdir below
printf 'systems: [../line.yaml]\nintegrators: rk4\nstep: 0.1\ntime: 1\n' >below/up.yaml
try 0 study below/up.yaml -o up --no-page
try 0 pack up
expect "tar" tar xf up.tar -C unpacked
copy=$(sed -n "s/^The study names '.*line\.yaml': that is \(.*\)\.$/\1/p" unpacked/up/README.txt)
expect "another system: $copy" cmp line.yaml "unpacked/up/$copy"

case_is "pack: the README of what is neither a run nor a study"
try 0 order damped-oscillator --integrators rk4 --levels 2 --time 1 --output orders
try 0 pack orders --output orders.tar
expect "tar" tar xf orders.tar -C unpacked
sed 's/by dalembert [0-9.]*\.$/by dalembert VERSION./; s/^ *[0-9][0-9]* /N /' unpacked/orders/README.txt >readme
cat >expected <<'END'
orders, packed by dalembert VERSION.

The request is in a file of this directory that ends in .json.

The version that made it, the compiler and the machine are in manifest.json, where there is one.

Bytes and names of the files:

N  order.csv
N  order.json
END
expect "another README" diff expected readme

case_is "pack: equal files make equal archives, and --all everything but locks"
cp -r disk copied
touch -d "2001-02-03" copied/summary.csv
mkdir elsewhere
mv copied elsewhere/disk
try 0 pack elsewhere/disk -o second.tar
expect "another archive" cmp -s disk.tar second.tar
try 0 pack pair --all -o -
expect "tar of standard output" tar tf out
expect "rows" sh -c "tar tf out | grep -q 'trajectory\.npy$'"
refute "a lock" sh -c "tar tf out | grep -q '/lock$'"
tar xf out -C elsewhere
expect "other bytes" diff -r -x lock -x README.txt -x builtin -x "a file.yaml" pair elsewhere/pair

case_is "pack: long names, links, and files of others"
long=$(printf '%0120d' 0)
mkdir -p "disk/$long/$long"
echo 2 >"disk/$long/short.csv"
ln -s /etc/passwd disk/passwd.txt
try 0 pack disk --force
expect "tar" sh -c "tar tf disk.tar >listed"
expect "a long name" grep -q "$long/short.csv" listed
refute "a link" grep -q passwd listed
echo 1 >"disk/$long/$long.csv"
try 2 pack disk -o other.tar
says "too long a name"
refute "half an archive" test -e other.tar
far=$(printf '%0170d' 0)
mv "disk/$long" beside && mv disk "$far"
try 2 pack "$far" -o other.tar
says "^dalembert: '$far/[a-z]*\.json' is too long a name$"
expect "it goes on" test "$(wc -l <err)" -eq 1
mv "$far" disk && mv beside "disk/$long"
mkdir "$far" && : >"$far/lock"
try 2 pack "$far" -o other.tar
says "^dalembert: '$far/README.txt' is too long a name$"

case_is "pack: a file whose length has no number in an archive"
cp -r pair large
if needs 3 "no file may have 8 GB" truncate -s 8589934592 large/trajectory.npy; then
    try 2 pack large --all
    says "^dalembert: 'large/trajectory.npy' has 8 GB or more$"
    refute "half an archive" test -e large.tar
    counted
fi
rm -r large

# Links are not packed, so that what pack adds itself is the first whose name has more than 155 letters before a slash.
case_is "pack: too long a name of the directory"
long=$(printf '%0200d' 0)
linked() {
    rm -rf "$long" && mkdir "$long"
    for file in "$@"; do ln -s "$PWD/$file" "$long"; done
}
refused() {
    try 2 pack "$long"
    alone "^dalembert: '$long/$1' is too long a name$"
    refute "half an archive" test -e "$long.tar"
}
linked disk/manifest.json disk/summary.csv disk/trajectory.npy
refused builtin/falling-disk.yaml
linked pair/study.yaml pair/manifest.json pair/systems
refused builtin/damped-oscillator.yaml
printf 'systems: [line.yaml]\nintegrators: rk4\nstep: 0.1\ntime: 1\n' >single.yaml
try 0 study single.yaml -o single --no-page
linked single/study.yaml single/manifest.json single/systems
refused line.yaml
linked orders/order.csv orders/order.json
refused README.txt
linked orders/order.csv
cp orders/order.json "$long"
refused order.json

case_is "pack: errors"
mkdir foreign
echo "not ours" >foreign/notes.txt
table <<'END'
2 | pack nodir | says there is no directory 'nodir'
2 | pack foreign | says 'foreign' holds no results of dalembert
2 | pack second.tar | says 'second.tar' is no directory
2 | pack pair | says 'pair.tar' exists; --force overwrites it
2 | pack | says DIR is missing
END
if needs 1 "no /dev/full" test -c /dev/full; then
    try 4 pack pair -o /dev/full
    counted
fi

case_is "pack: a manifest with an option that nobody knows"
cp -r elsewhere/disk unknown
sed 's/"step"/"stride"/' elsewhere/disk/manifest.json >unknown/manifest.json
try 2 pack unknown
says "unknown/manifest\.json:.*'stride'"
refute "an archive" test -e unknown.tar
