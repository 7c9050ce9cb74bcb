# summary.awk - one summary of the summaries of several runs of CUnit, in its form; BROKEN of them have none.
$1 == "suites" || $1 == "tests" || $1 == "asserts" {
    for (i = 2; i <= 6; i++) sum[$1, i] += $i
}
/^Elapsed time/ { seconds += $4 }
/^suite: [0-9]+ times tests are skipped/ { skips += $2 }
function line(kind, passed, inactive) {
    printf "%20s %6d %6d %6s %6d %8s\n", kind, sum[kind, 2], sum[kind, 3], passed, sum[kind, 5], inactive
}
END {
    if (skips) printf "suites: %d times tests are skipped\n", skips
    sum["suites", 2] += broken
    sum["suites", 3] += broken
    sum["suites", 5] += broken
    print "\nRun Summary:    Type  Total    Ran Passed Failed Inactive"
    line("suites", "n/a", sum["suites", 6] + 0)
    line("tests", sum["tests", 4] + 0, sum["tests", 6] + 0)
    line("asserts", sum["asserts", 4] + 0, "n/a")
    printf "\nElapsed time = %8.3f seconds\n", seconds
}
