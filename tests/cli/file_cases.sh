# Files of systems: those that are built in, and one to begin with.

case_is "the file of a built-in system"
for file in "$here"/../../systems/*.yaml; do
    try 0 show "$(basename "$file" .yaml)"
    expect "other bytes" cmp out "$file"
    silent
done
try 0 show knife-edge -o blade.yaml
empty
silent
expect "other bytes" cmp blade.yaml "$here/../../systems/knife-edge.yaml"
try 0 run knife-edge --integrator rk4 --step 0.1 --time 1
mv out builtin
try 0 run blade.yaml --integrator rk4 --step 0.1 --time 1
expect "other rows" cmp builtin out
try 0 show suslov --output -
prints '^title: Suslov problem$'

case_is "a file is never overwritten"
echo mine >mine.yaml
mkdir folder.yaml
for command in 'show suslov --output mine.yaml' 'new mine' 'new mine.yaml' 'new folder'; do
    try 2 $command
    says "^dalembert: '(mine|folder).yaml' exists; it is not overwritten$"
    empty
done
expect "it was" test "$(cat mine.yaml)" = mine
ln -s nowhere dangling.yaml
try 2 new dangling
expect "a link was followed" test ! -e nowhere
try 4 new nowhere/system
says "^dalembert: cannot write 'nowhere/system.yaml': No such file or directory$"
if needs 4 "no /dev/full" test -c /dev/full; then
    ln -s /dev/full full.yaml
    for command in 'new full' 'show suslov --output full.yaml'; do
        try 4 $command
        says "^dalembert: cannot write 'full.yaml': No space left on device$"
    done
    counted
fi
try 2 show knife-egde
says "^dalembert: unknown system 'knife-egde'; did you mean 'knife-edge'\?$"
try 2 show blade.yaml
says "^dalembert: unknown system 'blade.yaml'"
empty
try 2 new
says '^dalembert: the NAME is missing; usage: dalembert new NAME$'

case_is "a system to begin with"
try 0 new begun
empty
says "^dalembert: wrote 'begun.yaml': dalembert run begun.yaml$"
try 0 new folder.yaml/other.yaml
expect "other bytes" cmp begun.yaml folder.yaml/other.yaml
try 0 check begun.yaml
prints ', 0 failed$'
# Its command lines, and what it has in comments.
sed -n 's/^#     dalembert \(.*\)/\1/p' begun.yaml >commands
expect "no command lines" test "$(wc -l <commands)" -eq 2
while read -r words; do
    try 0 $(echo "$words" | sed 's/FILE/begun.yaml/')
done <commands
expect "no rows" test "$(wc -l <out)" -gt 50
says '^E .*larger'
says '^spin .*(exact|rounding)'
sed 's/^# \(forces:\)/\1/' begun.yaml >damped.yaml
expect "no forces" grep -q ^forces: damped.yaml
try 0 check damped.yaml
prints '^  energy E +ok +not conserved'
if needs 3 "no prlimit" there prlimit; then
    case_is "a file that cannot be written is not left"
    prlimit --fsize=64 "$program" new large 2>err
    expect "another status" test $? -eq 4
    says "^dalembert: cannot write 'large.yaml': File too large$"
    expect "half of it is left" test ! -e large.yaml
    counted
fi
