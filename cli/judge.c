/* judge.c - verdicts on observables, the same for runs and studies. */
#include "cli.h"

#include <math.h>
#include <string.h>

void cli_judge(const char *observable, const dal_statistics *statistics, int aborted,
               dal_finding *finding)
{
    const double greatest = dal_statistics_greatest(statistics);
    const double scale = strcmp(observable, "H") == 0 ? greatest : fmax(1.0, greatest);
    dal_statistics_judge(statistics, scale, aborted, finding);
}

const char cli_finding_heads[] = "amplitude,rate,rate_low,rate_high,exponent,verdict,confidence";

void cli_put_finding(FILE *out, const dal_finding *finding)
{
    const double numbers[] = {finding->amplitude, finding->rate, finding->rate_low,
                              finding->rate_high, finding->exponent};
    for (size_t i = 0; i < sizeof numbers / sizeof numbers[0]; i++) {
        fputc(',', out);
        cli_put(out, numbers[i]);
    }
    fprintf(out, ",%s,%.3g", dal_verdict_text(finding->verdict), finding->confidence);
}
