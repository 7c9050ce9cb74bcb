# Ensembles that grow have the bytes of an ensemble of that size from the beginning.

cat >root.yaml <<'END2'
coordinates: [x]
parameters: {s: 1}
lagrangian: x'^2/2
forces: {x: -s*sqrt(x)}
start: {x: 1}
END2
# Some of these members fail before t = 1, and more before t = 2.
members="ensemble root.yaml --integrator rk4 --step 0.01 --seed 3 --space physical --vary s=uniform(-0.9,4) --no-page"
# All files, except lock; the manifests except what the machine says.
same_ensemble() { diff -rq -x lock -x report "$1" "$2"; }

is_either() { same_ensemble whole "$1" >differs || same_ensemble begun "$1" >differs; }
# grows OPTIONS OTHERS ALL: resume with OTHERS of an ensemble with OPTIONS, which is the one with ALL.
grows() {
    rm -rf small whole
    try 0 $members $1 --output small

    try 0 resume small --no-page $2
    try 0 $members $3 --output whole
    expect "$1, then $2: other bytes" same_ensemble whole small
}

case_is "more members"
grows "--members 600 --times 0.5,1" "--members 1100" "--members 1100 --times 0.5,1"
grows "--members 10 --time 1" "--members 11 --threads 1" "--members 11 --time 1"
grows "--members 512 --time 1" "--members 513 --threads 2 --native off" "--members 513 --time 1"
grows "--members 10 --time 1" "--members 10" "--members 10 --time 1"
case_is "a later end"
grows "--members 300 --time 1" "--time 2" "--members 300 --time 2"
grows "--members 300 --time 1" "--steps 150" "--members 300 --steps 150"
grows "--members 300 --steps 100" "--time 2 --members 400" "--members 400 --time 2"
grows "--members 300 --times 0.5,1" "--time 2" "--members 300 --times 0.5,1 --time 2"
grows "--members 300 --times 0.5 --time 1" "--time 2" "--members 300 --times 0.5,1 --time 2"

# The chunks that are done are copied: of one with another number in it, that number stays.
case_is "members that are done are not run again"
rm -rf small
try 0 $members --members 512 --time 1 --output small
printf '\0\0\0\0\0\0\360\77' | dd of=small/final.npy bs=1 seek=$(($(wc -c <small/final.npy) - 8)) conv=notrunc 2>err
last=$(tail -c 8 small/final.npy | od -An -tx1)
try 0 resume small --no-page --members 600
expect "it was run again" test "$(head -c -$((88 * 16)) small/final.npy | tail -c 8 | od -An -tx1)" = "$last"

case_is "shards"
rm -rf small whole
try 0 $members --members 600 --time 1 --output small --shard 1/2
cp -r small kept
try 2 resume small --members 700
says "^dalembert: 'small' cannot grow: its shards are not done$"
expect "it was changed" diff -r small kept
try 0 $members --members 600 --time 1 --output small --shard 2/2
try 0 resume small --members 700 --no-page
try 0 $members --members 700 --time 1 --output whole
expect "other bytes" same_ensemble whole small

case_is "grown chunks that cannot be read"
mkdir small/chunks.grown
for command in "resume small --members 800" "merge small --output merged"; do
    try 4 $command --no-page
    says "^dalembert: cannot read 'small/chunks.grown': Is a directory$"
    expect "more messages: $command" test "$(wc -l <err)" -eq 1
    empty
done

case_is "made by MPI"
if needs 4 "no mpirun, or no dalembert-mpi (make mpi)" has_mpi; then
    rm -rf small whole
    by_mpi 0 -n 3 "$mpi_program" ${members%--no-page} --members 600 --time 1 --output small
    try 0 resume small --members 700 --no-page
    try 0 $members --members 700 --time 1 --output whole
    expect "other bytes" same_ensemble whole small
    counted
fi

if needs 58 "no compiler for signals at given places" raises; then
    # At every rename: of the grown chunks, the manifest, the tables, what is made of them.
    case_is "killed while it grows"
    rm -rf begun small whole
    try 0 $members --members 300 --times 0.5,1 --output begun
    try 0 $members --members 700 --times 0.5,1 --output whole
    for call in 1 2 3 4 5 6 7 8; do
        rm -rf small
        cp -r begun small
        cut_off 137 9 $call resume small --members 700 --no-page --threads 1
        cp -r small again
        try 0 resume small --no-page
        expect "call $call: neither the old nor the new one" \
            is_either small
        try 0 resume small --members 700 --no-page
        expect "call $call: other bytes" same_ensemble whole small
        try 0 resume again --members 700 --no-page
        expect "call $call, grown again: other bytes" same_ensemble whole again
        rm -r again
    done
    counted
fi
