# Outputs that are no plain new files: devices, FIFOs, sockets, links, files and directories of others; as
# this user and, where that is root, as another user, too.  The device is one of our own, a null device in
# the directory of the test, so that a mistake can replace no other.

circle="knife-edge --integrator rk4 --step 0.1 --time 1 --samples 10"
# Every command that writes one file, OUT; TEXT is in what it writes.
commands() {
    cat <<'LIST'
run knife-edge --integrator rk4 --step 0.1 --time 1 --samples 10 -o OUT|^t,
section knife-edge --integrator rk4 --step 0.1 --time 1 --on phi=1 -o OUT|^crossing,
lyapunov knife-edge --integrator rk4 --step 0.1 --time 1 --rows 2 -o OUT|^t,lambda1
volume knife-edge --integrator rk4 --step 0.1 --time 1 --rows 2 -o OUT|^t,divergence
explain line.yaml --integrator rk4 --step 0.1 --time 1 --quad-steps 0 -o OUT|^observable,
order line.yaml --integrators rk4 --step 0.1 --time 1 -o OUT|^label,
generate knife-edge --integrator rk4 -o OUT|knife_edge_rk4
run bounce.yaml --events OUT -o rows.csv|^t,event
LIST
}
cat >bounce.yaml <<'LIST'
coordinates: [y]
lagrangian: y'^2/2 - y
start: {y: 1}
events: [{when: y, direction: down, restitution: 0.5}]
defaults: {integrator: rk4, step: 0.1, time: 1.5}
LIST

# each_output CHECK: CHECK WORDS TEXT of each command, with $output for OUT.
each_output() {
    commands >list
    while IFS='|' read -r words text <&3; do
        "$1" "$(echo "$words" | sed "s|OUT|$output|")" "$text"
    done 3<list
}
writes() { # WORDS TEXT: the output gets the text
    written $1
    expect "status $? of $1" test $? -eq 0
    expect "no '$2': $1" grep -q "$2" received
}
is_device() { [ -c device ] && [ "$(stat -c %t:%T device)" = 1:3 ]; }

# outputs: all cases, by $as.
outputs() {
    output=fifo.csv
    case_is "a FIFO is written$who"
    mkfifo fifo.csv && chmod 666 fifo.csv
    written() {
        cat fifo.csv >received &
        $as "$program" "$@" >out 2>err
        status=$?
        # After a crash before it was opened this gives cat its end.
        if [ -p fifo.csv ]; then : 1<>fifo.csv; else kill $!; fi
        wait $!
        return $status
    }
    each_output writes
    expect "it is no FIFO any more" test -p fifo.csv
    case_is "a FIFO that nobody reads any more$who"
    head -c 10 fifo.csv >received &
    timeout --foreground $patience $as "$program" run $circle --samples 1000000 --time 1e5 --native off -o fifo.csv >out 2>err
    expect "exit $?, not 4" test $? -eq 4
    says "^dalembert: cannot write 'fifo.csv': Broken pipe$"
    wait $!

    case_is "a link is followed$who"
    output=link.csv
    written() {
        rm -f target.csv link.csv folder/*
        echo before >folder/target.csv
        chmod 640 folder/target.csv
        ln folder/target.csv folder/held
        ln -s middle.csv link.csv
        ln -sf folder/target.csv middle.csv
        [ -z "$owner" ] || chown "$owner" folder/target.csv
        $as "$program" "$@" >out 2>err || return 1
        cp folder/target.csv received
        [ -L link.csv ] && [ -L middle.csv ] && [ "$(cat folder/held)" = before ] &&
            [ "$(stat -c %a folder/target.csv)" = 640 ]
    }
    each_output writes
    expect "another file is left: $(ls -A folder)" test "$(ls -A folder | tr '\n' ' ')" = "held target.csv "
    rm -f folder/target.csv
    $as "$program" run $circle -o link.csv 2>err
    expect "a link to nothing is not followed" grep -q ^t, folder/target.csv

    case_is "a directory is none for a file$who"
    mkdir -p taken.csv
    [ -z "$owner" ] || chown "$owner" taken.csv
    output=taken.csv
    fails() {
        $as "$program" $1 >out 2>err
        expect "exit $?: $1" test $? -eq 4
        says "'taken.csv': Is a directory$"
    }
    commands | grep -v '^order\|^lyapunov\|^volume\|^section' >list
    while IFS='|' read -r words text <&3; do fails "$(echo "$words" | sed s/OUT/taken.csv/)"; done 3<list
    expect "it has files" test -z "$(ls -A taken.csv)"

    case_is "standard output by its name$who"
    if [ -e /dev/stdout ]; then
        for output in /dev/stdout /dev/fd/1; do
            echo before >received
            $as "$program" generate knife-edge --integrator rk4 -o $output >>received 2>err
            expect "not after what was there" test "$(head -n 1 received)" = before
            expect "nothing" grep -q knife_edge_rk4 received
            $as "$program" run $circle -o $output 2>err | cat >received
            expect "no rows" test "$(wc -l <received)" -eq 12
        done
        $as "$program" show suslov -o /dev/stdout >>received 2>err
        expect "show has not appended" sh -c 'head -n 1 received | grep -q ^t, && grep -q ^title: received'
        expect "no link any more" test -e /dev/stdout
    fi

    if [ -c device ]; then
        case_is "a device is written$who"
        output=device
        written() { echo >received; $as "$program" "$@" >out 2>err && is_device && echo "$text" | tr -d ^ >received; }
        each_output writes
        ln -s device to-device
        $as "$program" generate knife-edge --integrator rk4 -o to-device 2>err
        expect "it is replaced by its link" test $? -eq 0 -a -L to-device
        expect "show" $as "$program" show suslov -o device
        expect "it is no device any more" is_device
        rm -f to-device
    fi
}

who= as= owner=
mkdir folder
if [ "$(id -u)" -ne 0 ]; then
    cannot 11 "a device of our own: only root makes one"
elif ! mknod device c 1 3 2>err || ! chmod 666 device || ! echo >device 2>err; then
    rm -f device
    cannot 11 "a device of our own: $(head -n 1 err)"
fi
outputs

case_is "a socket is written"
if needs 7 "no python3" there python3; then
    cat >listen.py <<'LIST'
import socket, sys
server = socket.socket(socket.AF_UNIX)
server.bind('socket')
server.listen()
open('listening', 'w').close()
connection = server.accept()[0]
with open('received', 'wb') as file:
    while bytes_ := connection.recv(1 << 16):
        file.write(bytes_)
LIST
    python3 listen.py 2>log &
    listener=$!
    reaches $listener test -e listening
    try 0 generate knife-edge --integrator rk4 -o socket
    wait $listener
    expect "it got nothing" grep -q knife_edge_rk4 received
    expect "it is no socket any more" test -S socket
    try 4 generate knife-edge --integrator rk4 -o socket
    says "^dalembert: cannot write 'socket': Connection refused$"
    long=$(printf '%0120d' 0)
    mkdir "$long" && (cd "$long" && python3 -c "import socket; socket.socket(socket.AF_UNIX).bind('socket')")
    try 2 generate knife-edge --integrator rk4 -o "$long/socket"
    says "^dalembert: cannot write '$long/socket': File name too long$"
    counted
fi

case_is "files of others beside an output stay"
echo mine >rows.csv.new
try 0 run $circle -o rows.csv
try 0 generate knife-edge --integrator rk4 -o rows.csv
expect "rows.csv.new is mine" test "$(cat rows.csv.new)" = mine
expect "a file is left" test ! -e .rows.csv.new

case_is "rows of .npy need a file"
mkfifo fifo.npy
cat fifo.npy >received &
try 4 run $circle -o fifo.npy
says "fifo.npy"
wait $!

case_is "a directory of others"
mkdir project project/results project/runs project/messages
for file in notes.txt results/data.csv runs/first messages/1; do echo mine >project/$file; done
find project -type f -exec cat {} + >before
ls -R project >listed
printf 'integrators: [rk4]\nstep: 0.1\ntime: 1\nsystems: [plane.yaml]\n' >line-study.yaml
motion="knife-edge --integrator rk4 --step 0.1 --time 1"
for command in "run $motion" "order line.yaml --integrators rk4 --step 0.1 --time 1" \
    "section $motion --on phi=1" "lyapunov $motion --rows 2" "volume $motion --rows 2" "study line-study.yaml" \
    "ensemble line.yaml --members 2 --seed 1 --vary x=normal(0,1) --integrator rk4 --step 0.1 --time 1"; do
    try 2 $command --output project
    says "^dalembert: 'project' is not empty and holds no results of dalembert; --force writes into it$"
    empty
    ls -R project | cmp -s - listed
    expect "files are in it: $command" test $? -eq 0
    rm -rf copy && cp -R project copy
    try 0 $command --output copy --force
    for file in notes.txt results/data.csv runs/first messages/1; do
        expect "$file is gone: $command --force" test "$(cat copy/$file)" = mine
    done
    # what it has written is its own, in an empty directory also without force
    rm -rf fresh && mkdir fresh
    try 0 $command --output fresh
    echo mine >fresh/notes.txt
    case $command in
    run* | study* | ensemble*)
        try 2 $command --output fresh
        says "exists already|holds an ensemble"
        ;;
    *) try 0 $command --output fresh ;;
    esac
done
cp line-study.yaml plane.yaml project
cd project || exit 1
try 2 study line-study.yaml --output .
says "^dalembert: '\.' is not empty"
cd .. || exit 1
# The directory has a path, some of its files have none.
far=$(printf '%4068s' '' | sed 's,  ,./,g')far
try 0 study line-study.yaml --output far
try 2 study line-study.yaml --output "$far" --force
says "^dalembert: cannot remove '$far/.*': File name too long$"
expect "it goes on" test "$(wc -l <err)" -eq 1
mkdir shard
try 0 study line-study.yaml --shard 1/2 --output shard
try 0 study line-study.yaml --shard 2/2 --output shard
try 2 merge shard --output project
says "'project' is not empty"

if [ "$(id -u)" -ne 0 ]; then return 0; fi
# As nobody, in a directory that is its own: a device could be replaced there.
case_is "another user"
chmod 711 "$top"
mkdir other && cp "$program" line.yaml bounce.yaml other && chmod 755 other && chown -R 65534:65534 other
as="setpriv --reuid=65534 --regid=65534 --clear-groups"
reads_as_other() { there setpriv && $as test -r "$work/other/line.yaml" 2>err; }
if reads_as_other; then
    cd other || exit 1
    own=$program program=$work/other/${program##*/}
    [ ! -c ../device ] || { mknod device c 1 3 && chmod 666 device; }
    mkdir folder && chown 65534:65534 folder
    who=", as another user" owner=65534:65534
    outputs

    case_is "a file that may not be written stays as it is"
    $as sh -c 'echo mine >held.csv && chmod 444 held.csv'
    $as "$program" run $circle -o held.csv 2>err
    expect "exit $?, not 4" test $? -eq 4
    says "^dalembert: cannot write 'held.csv': Permission denied$"
    expect "it is written" test "$(cat held.csv)" = mine
    case_is "a file in a directory where none can be made"
    mkdir locked && echo before >locked/rows.csv && chown $owner locked/rows.csv
    $as "$program" run $circle -o locked/rows.csv 2>err
    expect "exit $?, not 0" test $? -eq 0
    expect "no rows" test "$(wc -l <locked/rows.csv)" -eq 12
    $as "$program" run $circle -o locked/new.csv 2>err
    expect "exit $?, not 4" test $? -eq 4
    says "^dalembert: cannot write 'locked/new.csv': Permission denied$"
    cd .. || exit 1
    program=$own
else
    skips 60 "no other user: $(head -n 1 err)"
fi
