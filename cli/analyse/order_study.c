/* order_study.c - what orders are measured of. */
#include "order_study.h"

#define OUTCOME_WORD(code, word) word,
const char *const order_outcome_words[] = {DAL_ORDER_OUTCOME_LIST(OUTCOME_WORD)};
#undef OUTCOME_WORD

long long order_count_steps(const order_study *s, double h)
{
    return dal_whole_steps(s->simulation->request.from, s->simulation->request.time, h);
}

const char *order_failure_message(const order_study *s, const order_method *m)
{
    int level = 0;
    while (level < s->levels - 1 && m->failure[level].status == DAL_STATUS_OK) level++;
    return m->failure[level].message;
}

dal_space order_space(const order_study *s, const order_method *m)
{
    const bool has_lift = !(dal_method_needs(&m->method) & DAL_NEEDS_BLOCKS);
    return has_lift || request_has(&s->simulation->request, REQUEST_space) ? s->spec.options.space
                                                                           : DAL_PHYSICAL;
}
