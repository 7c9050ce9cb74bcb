# The tools of the bench, on programs that print what is written here: no case measures a time.

bench=$here/../../bench
mkdir programs

# program NAME LINE...: a program that prints the next of the lines each time it is run.
program() {
    name=$1
    shift
    printf '%s\n' "$@" >"$name.lines"
    printf '#!/bin/sh\nhead -n 1 "%s"\nsed -i 1d "%s"\n' "$work/$name.lines" "$work/$name.lines" >programs/$name
    chmod +x programs/$name
}
# compares STATUS RUNS: runs the contenders of cases.txt.
compares() {
    expected=$1
    RUNS=$2 sh "$bench/run.sh" cases.txt programs results.jsonl >out 2>err
    ended $? run.sh
}

case_is "a table that begins with a case"
program slow '6 1 2' '8 1 2' '30 1 2'
program fast '2 1 2' '2 1 2' '3 1 2.5'
printf '%s\n' 'one | slow by fast | slow | fast | 1 | >= 3 | 0' >cases.txt
compares 0 3
expect "no head above it" test "$(sed -n 2p out | cut -c 1-4)" = case
prints '^one +slow by fast +4  \(3 to 10\)  >= 3 +met +0e\+00$'
expect "not the median" grep -q '"case":"one".*"median":4,"min":3,"max":10,"goal":">= 3","met":true' results.jsonl

case_is "a program that leaves a directory"
printf '#!/bin/sh\nmkdir -p "$0.cache" && echo 1\n' >programs/leaves && chmod +x programs/leaves
printf '%s\n' 'left | - | leaves | | 2 | - | -' >cases.txt
compares 0 1
prints '^left +- +2  \(2 to 2\)'
silent
expect "it stays" test "$(ls programs)" = "$(printf '%s\n' fast leaves slow)"

case_is "end states that differ, programs that fail or are not there"
program slow '6 1 2' '6 1 2'
program fast '2 1 2' '2 1 2.5'
printf '#!/bin/sh\nexit 3\n' >programs/fails && chmod +x programs/fails
cat >cases.txt <<'END_OF_CASES'
# a comment
same | - | slow | fast | 1 | <= 2 | 0
away | - | slow | not there | 1 | - | -
END_OF_CASES
compares 0 1
prints '^same .* MISS 0e\+00$'
prints '^away .* skipped: no program for not there$'
echo 'apart | - | slow | fast | 1 | - | 0.1' >>cases.txt
compares 1 1
prints '^apart .*END STATES DIFFER by 0.2$'
printf '%s\n' 'failing | - | fails | | 1 | - | -' >cases.txt
compares 1 1
prints '^failing .* FAILED: fails$'

case_is "errors that no tolerance reaches"
cat >programs/tolerances <<'END_OF_PROGRAM'
#!/bin/sh
case $1.$5 in
reference.*) echo a reference ;;
find.1e-13) echo - 2e-13 ;;
find.*) echo 3e-8 9e-7 ;;
esac
END_OF_PROGRAM
chmod +x programs/tolerances
sh "$bench/tolerances.sh" programs >tolerances.txt
expect "not every system, number of lanes, error and method" test "$(grep -c '^[^#]' tolerances.txt)" -eq 78
expect "no reference" grep -qx 'a reference' programs/reference.falling-disk
expect "no tolerance" grep -qxF 'taylor-8-1e-10 | A, 8 lanes, 1e-10 (3e-8) | tolerances time taylor A 8 1e-10 3e-8 | hand rk4 A | 1 | <= 270 | -' tolerances.txt
grep '^taylor-1-1e-13' tolerances.txt >cases.txt
compares 0 1
prints '^taylor-1-1e-13 +A, one lane, 1e-13: 2e-13 at best +not reached$'
cp programs/tolerances programs/heyoka
expect "no heyoka" test "$(sh "$bench/tolerances.sh" programs heyoka | grep -c '^heyoka-.*| heyoka time heyoka A ')" -eq 4

# The same as a page: three kinds of results, each with a figure, and a table that has its numbers.
case_is "sections of a table of cases"
program slow '6 1 2' '8 1 2' '30 1 2'
program fast '2 1 2' '2 1 2' '3 1 2'
cat >cases.txt <<'END_OF_CASES'
# no section
## First | parts of a second
# A text
# of two lines.
one | slow <by> fast | slow | fast | 1 | >= 3 | 0
## Second
two | the same | fast | slow | 1 | - | 0
END_OF_CASES
compares 0 3
expect "no machine" sh -c 'sed -n 1p results.jsonl | grep -q "\"processors\":[0-9]*,.*\"processes\":3}$"'
expect "no section" test "$(sed -n 2p results.jsonl)" = \
    '{"section":"First","unit":"parts of a second","figure":"ratios","text":"A text of two lines."}'
expect "no default" test "$(sed -n 4p results.jsonl)" = \
    '{"section":"Second","unit":"time of one side / time of the other","figure":"ratios","text":""}'

sh "$bench/sizes.sh" >sizes.txt
expect "not every size" test "$(grep -c '^gni-tape-.* dal tape gni physical R' sizes.txt)" -eq 7

maker=${program%/*}/bench/page
if needs 24 "no ${maker##*/bench/} of the bench" test -x "$maker"; then
    # makes STATUS RESULTS...: the page of results, by its own program.
    makes() {
        expected=$1
        shift
        "$maker" paged "$@" >out 2>err
        ended $? page "$@"
    }
    cat >sizes.jsonl <<'END_OF_RESULTS'
{"section":"Sizes","unit":"-","figure":"sizes","text":"By size."}
{"case":"a","what":"-","a":"dal tape rk4 physical R4","b":"","median":1.5,"min":1,"max":2,"goal":null,"met":null}
{"case":"b","what":"-","a":"dal tape rk4 physical R16","b":"","median":6.5,"min":6,"max":7,"goal":null,"met":null}
{"case":"c","what":"-","a":"dal native rk4 physical R4","b":"","median":0.25,"min":0.2,"max":0.3,"goal":null,"met":null}
END_OF_RESULTS
    cat >runs.jsonl <<'END_OF_RESULTS'
{"section":"Runs","figure":"runs","text":"By mode."}
{"system":"dir/S.yaml","method":"rk4","steps":10,"off":1.5,"on":2.5,"warm":0.5,"auto":1.25,"auto_warm":null}
{"system":"dir/S.yaml","method":"rk4","steps":100,"off":15,"on":3.5,"warm":1.5,"auto":3.75,"auto_warm":2}
END_OF_RESULTS
    case_is "the page of the bench"
    makes 0 results.jsonl sizes.jsonl runs.jsonl
    prints '^paged/report/index.html$'
    silent
    page=paged/report/index.html
    expect "no figures" test "$(grep -c '<figure>' $page)" -eq 4
    expect "no heads" test "$(grep -o '<h2>[A-Z][a-z]*</h2>' $page | tr -d '\n')" = \
        "<h2>First</h2><h2>Second</h2><h2>Sizes</h2><h2>Runs</h2>"
    expect "no text of a section" grep -q '<p>A text of two lines.</p>' $page
    expect "no row of a case" grep -q '<tr><th scope="row">one</th>.*>slow &lt;by&gt; fast</td><td>4</td><td>3 to 10</td><td>≥ 3</td><td class="kept">met</td></tr>$' $page
    expect "a case without a goal" grep -q '<tr><th scope="row">two</th>.*<td>0.25</td><td>0.1 to 0.3333</td><td></td><td></td></tr>$' $page
    expect "no sizes" grep -q '<td>interpreted</td><td>1.5</td><td>6.5</td></tr>$' $page
    expect "no sizes of compiled steps" grep -q '<td>compiled</td><td>0.25</td><td>–</td></tr>$' $page
    expect "no run" grep -q '<td>rk4</td><td>10</td><td>1.5 s</td><td>2.5 s</td><td>0.5 s</td><td>1.25 s</td><td>–</td></tr>$' $page
    expect "no data of the figure" sh -c "tr '\n' ' ' <paged/report/ratios-1.gp | grep -q 'curve1 << END 3,1 10,1 .*curve2 << END 4,1 .*curve3 << END 3,1 '"

    case_is "a section of which nothing was measured"
    printf '%s\n' '{"section":"A","text":"-"}' '{"case":"a","what":"w","median":null,"goal":"<= 2","met":null}' >skipped.jsonl
    makes 0 skipped.jsonl
    silent
    expect "no row" grep -q '<td>–</td><td>–</td><td>≤ 2</td><td>not measured</td></tr>$' $page
    printf '%s\n' '{"section":"A","text":"-"}' '{"case":"a","what":"w","a":"","median":null,"goal":"<= 2","met":null}' >skipped.jsonl
    makes 0 skipped.jsonl
    expect "measured" grep -q '<td>–</td><td>–</td><td>≤ 2</td><td>not reached</td></tr>$' $page

    case_is "results that are none"
    echo '{"case":"a"}' >none.jsonl
    makes 2 none.jsonl
    says '^dalembert: line 1 of none.jsonl: it is no result of a section$'
    printf '%s\n' '{"section":"A"}' '{"case":' >none.jsonl
    makes 2 none.jsonl
    says '^dalembert: line 2 of none.jsonl:1:9: '
    makes 4 nowhere.jsonl
    makes 2
    says 'DIR and RESULTS are required'
    counted
fi
