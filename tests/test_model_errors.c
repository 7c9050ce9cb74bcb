/* test_model_errors.c - bad system files: each with its status, its message and its place.  The
 * place is marked by @ in the text, which the test takes out. */
#include "quick.h"

#include <CUnit/Basic.h>
#include <dalembert.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Lines that are right, to put wrong ones beside them. */
#define XY "coordinates: [x, y]\n"
#define L  "lagrangian: (x'^2 + y'^2)/2\n"

typedef struct bad_file {
    dal_status status;
    const char *message, *text; /* no @: no place */
} bad_file;

/* ---- YAML ---- */

static const bad_file yaml[] = {
    {DAL_STATUS_SYNTAX, "the file is empty", "@"},
    {DAL_STATUS_SYNTAX, "the file is empty", "# nothing\n@"},
    {DAL_STATUS_SYNTAX, "a system file is a mapping, as 'coordinates: [x, y]'", "@- a\n- b\n"},
    {DAL_STATUS_SYNTAX, "a system file is a mapping, as 'coordinates: [x, y]'", "@hello"},
    {DAL_STATUS_SYNTAX, "malformed YAML: found character that cannot start any token",
     "@\ttitle: x\n"},
    {DAL_STATUS_SYNTAX, "malformed YAML: mapping values are not allowed in this context",
     "title: x\n  bad@: y\n"},
    {DAL_STATUS_SYNTAX, "malformed YAML: did not find expected ',' or ']'",
     "coordinates: [x, y\n@"},
    {DAL_STATUS_SYNTAX, "malformed YAML: found unexpected end of stream", "title: \"x\n@"},
    {DAL_STATUS_SYNTAX, "malformed YAML: invalid leading UTF-8 octet", "title: a\n# @\xff\n"},
    {DAL_STATUS_SYNTAX, "malformed YAML: invalid leading UTF-8 octet", "@\xff\n"},
    {DAL_STATUS_SYNTAX, "malformed YAML: did not find expected key", XY L "@}\n"},
    {DAL_STATUS_SYNTAX, "malformed YAML: did not find expected <document start>", XY L "...\n@}\n"},
    {DAL_STATUS_SYNTAX, "a second document begins here: a system file has one", XY L "@---\n" XY},
    {DAL_STATUS_SYNTAX, "malformed YAML: found character that cannot start any token",
     "--- {title: x} @`\n"},
    {DAL_STATUS_SYNTAX, "anchors and aliases are not supported", "title: @&a x\n"},
    {DAL_STATUS_SYNTAX, "anchors and aliases are not supported", "title: @*a\n"},
    {DAL_STATUS_SYNTAX, "a text holds a NUL character", "title: @\"a\\0b\"\n"},
    {DAL_STATUS_SYNTAX, "a text holds the control character U+001B", "title: @\"a\\e[31mb\"\n"},
    {DAL_STATUS_SYNTAX, "a text holds the control character U+009B", "reference: @\"\\x9b31m\"\n"},
    {DAL_STATUS_SYNTAX, "a text holds the control character U+007F", "start: {@\"x\\x7f\": 1}\n"},
    {DAL_STATUS_SYNTAX, "a name is expected here", "@[title]: x\n"},
    {DAL_STATUS_NAME, "unknown key 'titel'; did you mean 'title'?", XY "@titel: x\n"},
    {DAL_STATUS_NAME, "unknown key '<<'", "@<<: {a: b}\n"},
    {DAL_STATUS_MODEL, "duplicate key 'title'", "title: x\n" L "@title: y\n"},
    {DAL_STATUS_SYNTAX, "coordinates must be a list", "coordinates: @x\n"},
    {DAL_STATUS_SYNTAX, "constraints must be a list", "constraints: @{a: b}\n"},
    {DAL_STATUS_SYNTAX, "lagrangian must be one text", "lagrangian: @[x]\n"},
    {DAL_STATUS_SYNTAX, "parameters must be a mapping of names", "parameters: @[m]\n"},
    {DAL_STATUS_SYNTAX, "forces must be a mapping of names", "forces:@\n"},
    {DAL_STATUS_SYNTAX, "a text is expected in coordinates", "coordinates: [@[x]]\n"},
    {DAL_STATUS_SYNTAX, "a text is expected in start, or {for: i = 1..N, is: \"formula in i\"}",
     "start: {x: @{y: 1}}\n"},
    {DAL_STATUS_SYNTAX, "a text is expected in start, or {for: i = 1..N, is: \"formula in i\"}",
     "start: {x: @{is: {for: i = 1..2, is: 1}}}\n"},
    {DAL_STATUS_SYNTAX, "a name is expected here", "start: {@[x]: 1}\n"},
    {DAL_STATUS_SYNTAX, "reactions must be a list of mappings", "reactions: @{x: 1}\n"},
    {DAL_STATUS_SYNTAX, "reactions must be a list of mappings", "reactions: [{x: 1}, @y]\n"},
    {DAL_STATUS_SYNTAX, "a text is expected in reactions", "reactions: [{x: @[1]}]\n"},
    {DAL_STATUS_SYNTAX, "this list is empty", "reactions: [@]\n"},
    {DAL_STATUS_SYNTAX, "this mapping is empty", "reactions: [{x: 1}, {@}]\n"},
};

/* ---- events ---- */

static const bad_file events[] = {
    {DAL_STATUS_SYNTAX, "events must be a list of mappings", XY L "events: @{when: x}\n"},
    {DAL_STATUS_SYNTAX, "set must be a mapping of names, as {x': -x'}",
     XY L "events: [{when: x, set: @1}]\n"},
    {DAL_STATUS_SYNTAX, "this mapping is empty", XY L "events: [{when: x, set: {@}}]\n"},
    {DAL_STATUS_NAME, "unknown key of an event 'wen'; did you mean 'when'?",
     XY L "events: [{@wen: x}]\n"},
    {DAL_STATUS_MODEL, "event 1 has no 'when'", XY L "events: [{@stop: true}]\n"},
    {DAL_STATUS_MODEL, "duplicate 'when' in events", XY L "events: [{when: x, @when: y}]\n"},
    {DAL_STATUS_NAME, "event 2, when: unknown name 'z'",
     XY L "events: [{when: x}, {when: x - @z}]\n"},
    {DAL_STATUS_NAME, "event 1, set.y': unknown name 'z'",
     XY L "events: [{when: x, set: {y': -y' + @z}}]\n"},
    {DAL_STATUS_NAME, "unknown coordinate in set 'z'", XY L "events: [{when: x, set: {@z: 1}}]\n"},
    {DAL_STATUS_MODEL, "duplicate 'set.x' in events",
     XY L "events: [{when: x, set: {x: 1, @x: 2}}]\n"},
    {DAL_STATUS_NAME, "unknown direction 'dwn'; did you mean 'down'?",
     XY L "events: [{when: x, direction: @dwn}]\n"},
    {DAL_STATUS_NAME, "unknown value of stop 'yes'", XY L "events: [{when: x, stop: @yes}]\n"},
    {DAL_STATUS_MODEL, "event 1, when: it does not change along a run",
     XY L "events: [{when: @1}]\n"},
    {DAL_STATUS_MODEL, "event 1, when: it does not change along a run",
     XY "lagrangian: (x'^2 + y'^2)/2 - 9*y\nconstraints: [y' - x']\n"
        "events: [{when: @R_y - 9/2}]\n"},
    {DAL_STATUS_SYNTAX, "the range of an event is written i = 1..N",
     XY L "events: [{for: @1..2, when: x}]\n"},
    {DAL_STATUS_SYNTAX, "a range is written for i = 1..N",
     XY L "events: [{for: @i in 1..2, when: x}]\n"},
    {DAL_STATUS_SYNTAX, "a text is expected in events", XY L "events: [{for: @[1, 2], when: x}]\n"},
    {DAL_STATUS_NAME, "M: 'M' is no size", XY L "events: [{@for: i = 1..M, when: x}]\n"},
    {DAL_STATUS_TOO_LARGE, "500 events; at most 256 are possible",
     XY L "events: [{for: @i = 1..500, when: x}]\n"},
    {DAL_STATUS_SYNTAX, "the event has a range, and 'set.x[j]' another one",
     XY L "events: [{for: i = 1..2, when: x, set: {@\"x[j]\": {for: j = 1..2, is: 1}}}]\n"},
    {DAL_STATUS_NAME, "unknown coordinate in set 'x3'; did you mean 'x'?",
     XY L "events: [{for: i = 3..4, when: x, set: {@\"x[i]\": 1}}]\n"},
    {DAL_STATUS_MODEL, "event 1 has both 'set' and 'restitution'",
     XY L "events: [{@when: x, set: {x: 1}, restitution: 1}]\n"},
    {DAL_STATUS_MODEL, "event 1: the restitution -0.5 is negative",
     XY L "events: [{when: x, restitution: @-0.5}]\n"},
    {DAL_STATUS_MODEL, "event 1, restitution: the value is not finite",
     XY L "events: [{when: x, restitution: @log(0)}]\n"},
    {DAL_STATUS_UNSUPPORTED, "event 1 cannot have a restitution: its 'when' contains velocities",
     XY L "events: [{when: x + x', @restitution: 1}]\n"},
    {DAL_STATUS_UNSUPPORTED,
     "event 1 cannot have a restitution: its 'when' contains no coordinates",
     XY L "events: [{when: t - 1, @restitution: 1}]\n"},
    {DAL_STATUS_UNSUPPORTED,
     "event 1 cannot have a restitution: the mass matrix contains velocities",
     XY "lagrangian: -sqrt(1 - x'^2) + y'^2/2\nevents: [{when: x - 1, @restitution: 1}]\n"},
    {DAL_STATUS_UNSUPPORTED, "event 1 cannot have a restitution: vakonomic motion has no impacts",
     XY L "constraints: [x' - y*y']\nmechanics: vakonomic\n"
          "events: [{when: x - 1, @restitution: 1}]\n"},
    {DAL_STATUS_UNSUPPORTED,
     "event 1 cannot have a restitution: an actuator (reactions) has no impulses",
     XY L "constraints: [x' - y*y']\nreactions: [{x: 1}]\n"
          "events: [{when: x - 1, @restitution: 1}]\n"},
};

/* ---- names ---- */

static const bad_file names[] = {
    {DAL_STATUS_MODEL, "duplicate 'x' in coordinates", "coordinates: [x, @x]\n"},
    {DAL_STATUS_MODEL, "duplicate 'm' in parameters", XY L "parameters: {m: 1, @m: 2}\n"},
    {DAL_STATUS_MODEL, "duplicate 'x' in start", XY L "start:\n  x: 1\n  @x: 1\n"},
    {DAL_STATUS_MODEL, "duplicate 'a' in tags", "tags: [a, @a]\n"},
    {DAL_STATUS_NAME, "'2y' in coordinates is not a name: a letter, then letters, digits and _",
     "coordinates: [x, @2y]\n"},
    {DAL_STATUS_NAME,
     "'a b' in invariants is not a name: a letter, then letters, digits and _; is a bracket not "
     "closed?",
     "invariants: {@a b: x}\n"},
    {DAL_STATUS_NAME, "'x''' in start is not a name: a letter, then letters, digits and _",
     "start: {@x'': 1}\n"},
    {DAL_STATUS_NAME, "'x'' in forces is not a name: a letter, then letters, digits and _",
     "forces: {@x': 1}\n"},
    {DAL_STATUS_MODEL, "parameter 'x': a coordinate already has this name",
     XY L "parameters: {@x: 1}\n"},
    {DAL_STATUS_MODEL, "let 'm': a parameter already has this name",
     XY L "parameters: {m: 1}\nlet: {@m: 1}\n"},
    {DAL_STATUS_NAME, "coordinate 't': this name is reserved in formulas",
     "coordinates: [x, @t]\n" L},
    {DAL_STATUS_NAME, "coordinate 'e': this name is reserved in formulas",
     "coordinates: [x, @e]\n" L},
    {DAL_STATUS_NAME, "parameter 'pi': this name is reserved in formulas",
     XY L "parameters: {@pi: 3}\n"},
    {DAL_STATUS_NAME, "let 'sin': this name is reserved in formulas", XY L "let: {@sin: x}\n"},
    {DAL_STATUS_NAME, "coordinate 'E': this name is reserved for a column of the output",
     "coordinates: [x, @E]\n" L},
    {DAL_STATUS_NAME, "coordinate 'D12': this name is reserved for a column of the output",
     "coordinates: [x, @D12]\n" L},
    {DAL_STATUS_NAME, "coordinate 'p_x': this name is reserved for a column of the output",
     "coordinates: [x, @p_x]\n" L},
    {DAL_STATUS_NAME, "coordinate 'pi_e': this name is reserved for a column of the output",
     "coordinates: [x, @pi_e]\n" L},
    {DAL_STATUS_NAME, "coordinate 'g1': this name is reserved for a column of the output",
     "mechanics: vakonomic\ncoordinates: [x, @g1]\n" L},
    {DAL_STATUS_NAME, "invariant 'H': this name is reserved for a column of the output",
     XY L "invariants: {@H: x}\n"},
    {DAL_STATUS_NAME, "invariant 'error': this name is reserved for a column of the output",
     XY L "invariants: {@error: x}\n"},
    {DAL_STATUS_MODEL, "invariant 'x': a coordinate already has this name",
     XY L "invariants: {@x: y}\n"},
    {DAL_STATUS_NAME, "unknown coordinate in forces 'yy'; did you mean 'y'?",
     XY L "forces: {@yy: 1}\n"},
    {DAL_STATUS_MODEL, "duplicate 'x' in reactions", "reactions: [{x: 1}, {x: 1, @x: 2}]\n"},
    {DAL_STATUS_NAME, "unknown coordinate in reactions 'xx'; did you mean 'x'?",
     XY L "constraints: [x', y']\nreactions: [{x: 1}, {y: 1, @xx: 1}]\n"},
    {DAL_STATUS_NAME, "unknown coordinate in accelerations 'z'", XY "accelerations: {@z: 1}\n"},
    {DAL_STATUS_NAME, "unknown coordinate in exact 'z'", XY L "exact: {x: 1, @z: 1}\n"},
    {DAL_STATUS_NAME, "unknown name in start 'yy''; did you mean 'y''?", XY L "start: {@yy': 1}\n"},
    {DAL_STATUS_NAME, "unknown name in start 'g1'",
     XY L "mechanics: vakonomic\nstart: {@g1: 1}\n"}, /* there is no constraint */
    {DAL_STATUS_NAME, "the start of e belongs under gauge, as 'gauge: {e: 1}'",
     XY L "start: {@e: 2}\n"},
    {DAL_STATUS_NAME, "unknown entry of gauge 'mu'; did you mean 'mu_e'?",
     XY L "gauge: {@mu: 1}\n"},
    {DAL_STATUS_NAME, "unknown entry of picture 'angel'; did you mean 'angle'?",
     XY L "picture: {x: x, y: y, @angel: 0}\n"},
    {DAL_STATUS_NAME, "unknown body 'sleigth'; did you mean 'sleigh'?",
     XY L "picture: {x: x, y: y, body: @sleigth}\n"},
    {DAL_STATUS_MODEL, "picture has no y: it needs x and y", XY L "picture: {@x: x, angle: y}\n"},
    {DAL_STATUS_NAME, "picture width: unknown name 'z'",
     XY L "picture: {x: x, y: y, width: 2*@z}\n"},
    {DAL_STATUS_SYNTAX, "picture must be a mapping of names", XY L "picture: @sleigh\n"},
    {DAL_STATUS_NAME, "unknown entry of defaults 'stp'; did you mean 'step'?",
     XY L "defaults: {time: 1, @stp: 0.1}\n"},
    {DAL_STATUS_SYNTAX, "step in defaults: '1/10' is not a positive number",
     XY L "defaults: {step: @1/10}\n"},
    {DAL_STATUS_SYNTAX, "time in defaults: '0' is not a positive number",
     XY L "defaults: {time: @0}\n"},
    {DAL_STATUS_SYNTAX, "defaults must be a mapping of names", XY L "defaults: @rk4\n"},
    {DAL_STATUS_NAME, "unknown mechanics 'vakonomc'; did you mean 'vakonomic'?",
     XY L "mechanics: @vakonomc\n"},
};

/* ---- formulas ---- */

static const bad_file formulas[] = {
    {DAL_STATUS_NAME, "lagrangian: unknown name 'z'", XY "lagrangian: (x'^2 + @z'^2)/2\n"},
    {DAL_STATUS_NAME, "constraint 2: unknown name 'omgea'; did you mean 'omega'?",
     "parameters: {omega: 1}\n" XY L "constraints:\n  - x'\n  - y' - @omgea\n"},
    {DAL_STATUS_NAME, "reaction 2 on y: unknown name 'z'",
     XY L "constraints: [x', y']\nreactions:\n  - {x: 1}\n  - {x: 1, y: x + @z}\n"},
    {DAL_STATUS_NAME, "constraint 1: unknown function 'si'; did you mean 'sin'?",
     XY L "constraints: [x'*@si(x)]\n"},
    {DAL_STATUS_NAME, "force on y: parameter 'm' has no velocity",
     XY L "parameters: {m: 1}\nforces: {y: x*@m'}\n"},
    {DAL_STATUS_NAME, "invariant c: e is the gauge variable; exp(1) is Euler's number",
     XY L "invariants: {c: x*@e^2}\n"},
    {DAL_STATUS_SYNTAX, "lagrangian: a '(' is never closed", XY "lagrangian: @(x'^2 + y'^2/2\n"},
    {DAL_STATUS_SYNTAX, "lagrangian: an operator is missing: write 2*x", XY "lagrangian: 2@x\n"},
    {DAL_STATUS_SYNTAX, "lagrangian: division by zero", XY "lagrangian: x'@/0\n"},
    {DAL_STATUS_SYNTAX, "lagrangian: the formula is empty", XY "lagrangian: '@'\n"},
    {DAL_STATUS_SYNTAX, "lagrangian: the formula is empty", XY "lagrangian:@\n"},
    {DAL_STATUS_SYNTAX, "lagrangian: x'' is a second derivative; a formula knows only x and x'",
     XY "lagrangian: \"x'^2 + x'@'\"\n"},
    {DAL_STATUS_SYNTAX, "constraint 1: y'' is a second derivative; a formula knows only y and y'",
     XY L "constraints: [\"y'@'\"]\n"},
    /* Places in every kind of YAML text. */
    {DAL_STATUS_NAME, "lagrangian: unknown name 'z'", XY "lagrangian: \"x'^2 + @z\"\n"},
    {DAL_STATUS_NAME, "lagrangian: unknown name 'z'", XY "lagrangian: 'x''^2 + y''^2 + @z'\n"},
    {DAL_STATUS_NAME, "lagrangian: unknown name 'z'", XY "lagrangian: x'^2\n  +\n    y'^2 + @z\n"},
    {DAL_STATUS_NAME, "lagrangian: unknown name 'z'",
     XY "lagrangian: |\n  x'^2\n  + @z\ntags: []\n"},
    {DAL_STATUS_NAME, "lagrangian: unknown name 'z'",
     XY "lagrangian: >-\n\n  x'^2\n    + @z\ntags: []\n"},
    {DAL_STATUS_NAME, "lagrangian: unknown name 'z'",
     "title: \"\xc3\xa4\"\n" XY "lagrangian: @z\n"},
    {DAL_STATUS_NAME, "lagrangian: unknown name 'z'", "\xef\xbb\xbf" XY "lagrangian: x + @z\n"},
    {DAL_STATUS_NAME, "lagrangian: unknown name 'z'", "# one\r\n" XY "lagrangian: x\r\n  + @z\r\n"},
    /* Which names are allowed where. */
    {DAL_STATUS_NAME, "parameter m: unknown name 'k'", XY L "parameters: {m: @k, k: 1}\n"},
    {DAL_STATUS_NAME, "let a: unknown name 'bcd'", XY L "let: {a: @bcd, bcd: 1}\n"},
    {DAL_STATUS_SYNTAX, "parameter m: the number 1e999 is too large",
     XY L "parameters: {m: @1e999}\n"},
    {DAL_STATUS_MODEL, "parameter m: the value is not finite",
     XY L "parameters: {m: @exp(1000)}\n"},
    {DAL_STATUS_MODEL, "start of x': the value is not finite", XY L "start: {x': @log(0)}\n"},
    {DAL_STATUS_NAME,
     "start of x: coordinate 'y' may not stand here: only parameters, t and "
     "what start gives before",
     XY L "start: {x: 1 + @y}\n"},
    {DAL_STATUS_NAME,
     "start of x: the velocity of 'y' may not stand here: only parameters, t and "
     "what start gives before",
     XY L "start: {x: @y'}\n"},
    {DAL_STATUS_NAME,
     "start of x: let 'a' may not stand here: only parameters, t and "
     "what start gives before",
     XY L "let: {a: x'}\nstart: {x: @a}\n"},
    {DAL_STATUS_NAME, "gauge e: let 'a' may not stand here: only parameters",
     XY L "let: {a: t}\ngauge: {e: @a}\n"},
    {DAL_STATUS_NAME, "gauge e: coordinate 'x' may not stand here: only parameters",
     XY L "gauge: {e: 1 + @x}\n"},
    {DAL_STATUS_NAME,
     "exact solution for x: coordinate 'y' may not stand here: only parameters and t",
     XY L "exact: {x: @y, y: 1}\n"},
};

/* ---- functions ---- */

static const bad_file functions[] = {
    {DAL_STATUS_NAME, "'V' in functions is not a function with its arguments, as V(r)",
     XY L "functions: {@V: x}\n"},
    {DAL_STATUS_NAME, "'V()' in functions is not a function with its arguments, as V(r)",
     XY L "functions: {@V(): x}\n"},
    {DAL_STATUS_NAME, "'V(r' in functions is not a function with its arguments, as V(r)",
     XY L "functions: {@V(r: x}\n"},
    {DAL_STATUS_NAME, "'V(r s)' in functions is not a function with its arguments, as V(r)",
     XY L "functions: {@V(r s): x}\n"},
    {DAL_STATUS_NAME,
     "'2(r)' in functions is not a name: a letter, then letters, digits and _; a formula with "
     "commas within {} or [] needs quotes",
     XY L "functions: {@2(r): x}\n"},
    {DAL_STATUS_NAME, "function V has two arguments 'r'", XY L "functions: {@\"V(r, r)\": r}\n"},
    {DAL_STATUS_NAME, "function 'sin': this name is reserved in formulas",
     XY L "functions: {@sin(r): r}\n"},
    {DAL_STATUS_MODEL, "function 'x': a coordinate already has this name",
     XY L "functions: {@x(r): r}\n"},
    {DAL_STATUS_MODEL, "function 'V': a function already has this name",
     XY L "functions: {V(r): r, @V(s): s}\n"},
    {DAL_STATUS_NAME,
     "function V(r): coordinate 'x' may not stand here: only arguments and parameters",
     XY L "functions: {V(r): r*@x}\n"},
    {DAL_STATUS_NAME, "function V(r): unknown function 'W'",
     XY L "functions: {U(r): r, V(r): @W(r), W(r): r}\n"},
    {DAL_STATUS_NAME, "lagrangian: unknown function 'torqe'; did you mean 'torque'?",
     XY "functions: {torque(r): r}\nlagrangian: x'^2 + @torqe(x)\n"},
    {DAL_STATUS_SYNTAX, "lagrangian: V is a function: write V(...)",
     XY "functions: {V(r): r}\nlagrangian: x'^2 + @V\n"},
    {DAL_STATUS_SYNTAX, "lagrangian: f takes 2 arguments, not 1",
     XY "functions: {\"f(r, s)\": r}\nlagrangian: x'^2 + @f(x)\n"},
    {DAL_STATUS_SYNTAX, "lagrangian: max is not a function: write max*(...) for a product",
     XY "parameters: {max: 1}\nlagrangian: x'^2 + @max(x, y)\n"},
    {DAL_STATUS_SYNTAX, "lagrangian: sum is not a function: write sum*(...) for a product",
     XY "parameters: {sum: 1}\nlagrangian: x'^2 + @sum(i, 1, 2, i)\n"},
};

/* ---- sizes and indices ---- */

#define C24  "cccccccccccccccccccccccc"
#define MANY "sizes: {N: 3}\ncoordinates: [\"x[1..N]\"]\n"

static const bad_file indices[] = {
    {DAL_STATUS_TOO_LARGE, "the indices make more than 65536 entries",
     "coordinates: [\"@x[1..70000]\"]\n"},
    {DAL_STATUS_TOO_LARGE,
     "'cccccccccccccccccccccccccccccccccccccccc...' in parameters has more than 100 characters",
     "sizes: {N: 100000}\n" XY L "parameters: {@\"" C24 C24 C24 C24 "c[N]\": 1}\n"},
    {DAL_STATUS_NAME, "M + 1: 'M' is no size", "sizes: {@N: M + 1, M: 2}\n" XY L},
    {DAL_STATUS_MODEL, "'5/2' is not a whole number from 0 to 1000000", "sizes: {@N: 5/2}\n" XY L},
    {DAL_STATUS_MODEL, "'0 - 1' is not a whole number from 0 to 1000000",
     "sizes: {@N: 0 - 1}\n" XY L},
    {DAL_STATUS_MODEL, "parameter 'N': a size already has this name",
     "sizes: {N: 2}\n" XY L "parameters: {@N: 1}\n"},
    {DAL_STATUS_NAME, "K: 'K' is no size", "coordinates: [\"@x[1..K]\"]\n"},
    {DAL_STATUS_NAME, "'x[1..2' in coordinates is not a name: a letter, then letters, digits and _",
     "coordinates: [\"@x[1..2\"]\n"},
    {DAL_STATUS_MODEL, "duplicate 'x2' in coordinates", "coordinates: [\"x[1..3]\", @x2]\n"},
    {DAL_STATUS_NAME, "lagrangian: unknown name 'x4'; did you mean 'x1'?",
     MANY "lagrangian: @x[N+1]'^2\n"},
    {DAL_STATUS_SYNTAX, "lagrangian: an index is a whole number, of numbers, sizes and indices",
     MANY "lagrangian: @x[N/2]\n"},
    {DAL_STATUS_SYNTAX, "lagrangian: an index is a whole number, of numbers, sizes and indices",
     MANY "lagrangian: @x[x1]\n"},
    {DAL_STATUS_SYNTAX, "lagrangian: an index is a whole number, of numbers, sizes and indices",
     MANY "lagrangian: @sum(i, x1, N, x[i])\n"},
    {DAL_STATUS_SYNTAX, "lagrangian: an index is a whole number, of numbers, sizes and indices",
     MANY "lagrangian: @sum(i, 1, N/2, x[i])\n"},
    {DAL_STATUS_SYNTAX, "lagrangian: a value is missing before ']'", MANY "lagrangian: x[1/@]\n"},
    {DAL_STATUS_SYNTAX, "lagrangian: a '[' is never closed", MANY "lagrangian: @x[1\n"},
    {DAL_STATUS_SYNTAX, "lagrangian: ']' closes no '['", MANY "lagrangian: (x1@]\n"},
    {DAL_STATUS_SYNTAX, "lagrangian: a sum is written sum(i, 1, N, formula in i)",
     MANY "lagrangian: @sum(1, N, x1)\n"},
    {DAL_STATUS_SYNTAX, "lagrangian: a sum is written sum(i, 1, N, formula in i)",
     MANY "lagrangian: @sum(i, 1, N)\n"},
    {DAL_STATUS_SYNTAX, "lagrangian: a '(' is never closed",
     MANY "lagrangian: @sum(i, 1, N, x[i]\n"},
    {DAL_STATUS_NAME, "lagrangian: unknown name 'i'; did you mean 'pi'?",
     MANY "lagrangian: sum(i, 1, N, x[i]) + @i\n"},
    {DAL_STATUS_TOO_LARGE, "lagrangian: sums of more than 4000000 terms in a formula",
     MANY "lagrangian: sum(i, 1, 10000, @sum(j, 1, 10000, 1))\n"},
    {DAL_STATUS_TOO_LARGE, "lagrangian: sums of more than 4000000 terms in a formula",
     MANY "lagrangian: sum(i, 1, 1000, sum(j, i, 1000, @sum(k, j, 1000, x1^2*i*j*k)))\n"},
    {DAL_STATUS_SYNTAX, "lagrangian: an index is beyond 1000000",
     MANY "lagrangian: x1 + @sum(i, 1, 1e9, x1)\n"},
    {DAL_STATUS_MODEL, "duplicate key 'is'",
     MANY "lagrangian: x1\nforces: {\"x[i]\": {is: x1, for: i = 1..N, @is: x2}}\n"},
    {DAL_STATUS_MODEL, "duplicate key 'for'",
     MANY "lagrangian: x1\nforces: {\"x[i]\": {for: i = 1..2, @for: i = 1..N, is: x1}}\n"},
    {DAL_STATUS_NAME, "force on x2: unknown name 'x4'; did you mean 'x1'?",
     MANY "lagrangian: sum(i, 1, N, x[i]'^2)\n"
          "forces: {\"x[i]\": {for: i = 1..N, is: \"x[2] + @x[i+2]\"}}\n"},
    {DAL_STATUS_SYNTAX, "a range is written for i = 1..N",
     MANY "lagrangian: x1\nforces: {\"x[i]\": {for: i in 1..N, is: @x1}}\n"},
    {DAL_STATUS_SYNTAX, "' 1' is not a range, as 1..N",
     MANY "lagrangian: x1\nforces: {@\"x[i]\": {for: i = 1, is: x1}}\n"},
};

/* ---- mechanics ---- */

static const bad_file mechanics[] = {
    {DAL_STATUS_MODEL, "the system has no coordinates", L},
    {DAL_STATUS_MODEL, "the system has no coordinates", "coordinates: []\nlagrangian: 1\n"},
    {DAL_STATUS_MODEL, "the system has neither a lagrangian nor accelerations nor equations", XY},
    {DAL_STATUS_MODEL, "equations has 1 of 2 formulas, and there is no lagrangian",
     XY "equations: [@x'' + x]\n"},
    {DAL_STATUS_UNSUPPORTED, "equation 2 is not linear in x'', and there is no lagrangian",
     XY "equations: [x'', @x''*y'']\n"},
    {DAL_STATUS_UNSUPPORTED,
     "constraints need equations with a symmetric matrix of the second derivatives, as m*x'' + f "
     "and m*y'' + g",
     XY "equations: [x'' + y'', y'']\nconstraints: [@x']\n"},
    {DAL_STATUS_SINGULAR_MASS,
     "the mass matrix is singular: it does not determine the acceleration of 'y'",
     XY "equations: [x'' + y'', x'' + y'' - x]\n"},
    {DAL_STATUS_MODEL, "vakonomic mechanics needs a lagrangian, not equations",
     XY "mechanics: vakonomic\nequations: [@x'', y'']\n"},
    {DAL_STATUS_MODEL, "the system has both a lagrangian and accelerations",
     XY L "accelerations: {@x: 1}\n"},
    {DAL_STATUS_MODEL, "vakonomic mechanics needs a lagrangian, not accelerations",
     XY "mechanics: vakonomic\naccelerations: {@x: 1}\n"},
    {DAL_STATUS_MODEL, "exact has 1 of 2 coordinates: it needs a formula for each",
     XY L "exact: {@x: t}\n"},
    {DAL_STATUS_SINGULAR_MASS,
     "the mass matrix is singular: it does not determine the acceleration of 'y'",
     XY "lagrangian: @x'^2/2 - y\n"},
    {DAL_STATUS_SINGULAR_MASS,
     "the mass matrix is singular: it does not determine the acceleration of 'y'",
     XY "lagrangian: @(x' + x*y')^2/2\n"},
    {DAL_STATUS_RANK,
     "constraint 1 does not depend on the velocities; f(q) = 0 belongs under holonomic",
     XY L "constraints: [@x - y]\n"},
    {DAL_STATUS_MODEL, "vakonomic mechanics has no reactions: its multipliers take their place",
     XY L "mechanics: vakonomic\nconstraints: [x']\nreactions: [{@x: 1}]\n"},
    {DAL_STATUS_MODEL, "reaction 2 has no constraint: there are 1",
     XY L "constraints: [x']\nreactions: [{x: 1}, {@y: 1}]\n"},
    {DAL_STATUS_MODEL, "reaction 1 has no constraint: there are 0", XY L "reactions: [{@y: 1}]\n"},
    {DAL_STATUS_MODEL, "constraint 2 has no reaction: the list needs one for each",
     XY L "constraints: [x', y']\nreactions: [{@x: 1}]\n"},
    {DAL_STATUS_RANK, "constraint 1 is not held by the reactions: A W^-1 B^T is singular",
     XY L "constraints: [@x']\nreactions: [{y: 1}]\n"},
    {DAL_STATUS_RANK, "3 constraints on 2 coordinates", XY L "constraints: [x', y', @x' + y']\n"},
    {DAL_STATUS_RANK, "constraint 2 is redundant, it depends on 1: A W^-1 A^T is singular",
     XY L "constraints: [x' + y', @x*(x' + y')]\nstart: {x: 1}\n"},
    {DAL_STATUS_RANK, "constraint 2 is redundant, it depends on 1: A W^-1 A^T is singular",
     XY L "constraints: [1e9*x' + y', @x' + 1e-9*y']\n"},
    {DAL_STATUS_RANK,
     "constraint 2 nearly depends on 1: they differ by 1e-09 of its coefficients, and A W^-1 A^T "
     "is singular in double precision",
     XY L "constraints: [x' + 1e-9*y', @x' + 2e-9*y']\n"},
    {DAL_STATUS_RANK, "constraint 2 is redundant, it depends on 1: A W^-1 A^T is singular",
     XY L "mechanics: vakonomic\nconstraints: [x' + y', @x*(x' + y')]\nstart: {x: 1}\n"},
    {DAL_STATUS_SINGULAR_MASS,
     "the mass matrix is singular: it does not determine the acceleration of 'y'",
     XY "mechanics: vakonomic\nlagrangian: @x'^2/2 - y\nconstraints: [x']\n"},
    {DAL_STATUS_RANK, "constraint 4 is redundant, it depends on 1, 3: A W^-1 A^T is singular",
     "coordinates: [x, y, z, w]\nlagrangian: x'^2 + y'^2 + z'^2 + w'^2\n"
     "constraints: [x' - y*w', 5*y' + w', 7*z', @2*x' - 2*y*w' + y*z']\n"},
};

/* ---- the check ---- */

static dal_status make(const char *text, size_t length, dal_error *error)
{
    dal_model *model;
    const dal_system *system;
    dal_status status = dal_model_read(&model, "text", text, length, error);
    if (status == DAL_STATUS_OK) status = dal_model_system(model, &system, error);
    dal_model_free(model);
    return status;
}

/* Columns count characters, so continuation bytes do not count; nor does the mark of the
 * byte order. */
static void place_of(const char *text, const char *at, int *line, int *column)
{
    *line = *column = at ? 1 : 0;
    for (; at && text < at; text++) {
        int continues = ((unsigned char)*text & 0xC0) == 0x80 || *text == '\xef';
        *column = *text == '\n' ? 1 : *column + !continues;
        *line += *text == '\n';
    }
}

static void check(const bad_file *bad)
{
    char text[512];
    const char *at = strchr(bad->text, '@');
    int line, column;
    dal_error error = {.line = -1};
    place_of(bad->text, at, &line, &column);
    strcpy(text, bad->text);
    if (at) strcpy(text + (at - bad->text), at + 1);
    dal_status status = make(text, strlen(text), &error);
    int right = status == bad->status && error.status == status && error.line == line &&
                error.column == column && strcmp(error.message, bad->message) == 0;
    if (!right)
        printf("\n%s    says %d:%d %s %s\n    not  %d:%d %s\n", bad->text, error.line, error.column,
               dal_status_name(status), error.message, line, column, bad->message);
    CU_ASSERT(right);
}

#define CHECK_ALL(list)                                                                            \
    for (size_t i = 0; i < sizeof(list) / sizeof *(list); i++) check(&(list)[i])

static void test_yaml(void) { CHECK_ALL(yaml); }
static void test_names(void) { CHECK_ALL(names); }
static void test_events(void) { CHECK_ALL(events); }
static void test_formulas(void) { CHECK_ALL(formulas); }
static void test_functions(void) { CHECK_ALL(functions); }
static void test_indices(void) { CHECK_ALL(indices); }
static void test_mechanics(void) { CHECK_ALL(mechanics); }

/* Escapes and doubled quotes are YAML's. */
static void test_quotes(void)
{
    static const char *const texts[] = {XY "lagrangian: \"(x'^2 + \\x79'^2)/2\"\n",
                                        XY "lagrangian: '(x''^2 + y''^2)/2'\n",
                                        XY "lagrangian: |\n\n    (x'^2\n     + y'^2)/2\n",
                                        XY "lagrangian: (x'^2 # half\nforces: {}\n"};
    dal_error error;
    for (int i = 0; i < 3; i++)
        CU_ASSERT(make(texts[i], strlen(texts[i]), &error) == DAL_STATUS_OK);
    CU_ASSERT(make(texts[3], strlen(texts[3]), &error) == DAL_STATUS_SYNTAX);
    CU_ASSERT_STRING_EQUAL(error.message, "lagrangian: a '(' is never closed");
}

/* ---- what is no text ---- */

static void test_bytes(void)
{
    dal_error error;
    CU_ASSERT(make("title: a\n\0b", 11, &error) == DAL_STATUS_SYNTAX);
    CU_ASSERT_STRING_EQUAL(error.message, "the file holds a NUL byte");
    CU_ASSERT(error.line == 2 && error.column == 1);
    size_t length = ((size_t)1 << 22) + 1;
    char *spaces = malloc(length);
    CU_ASSERT_FATAL(spaces != NULL);
    memset(spaces, ' ', length);
    CU_ASSERT(make(spaces, length, &error) == DAL_STATUS_TOO_LARGE);
    CU_ASSERT_STRING_EQUAL(error.message, "more than 4194304 bytes in a system file");
    CU_ASSERT(make(spaces, length - 1, &error) == DAL_STATUS_SYNTAX);
    CU_ASSERT_STRING_EQUAL(error.message, "the file is empty");
    free(spaces);
}

static void check_file(const char *path, dal_status status, const char *message)
{
    dal_model *model;
    dal_error error;
    CU_ASSERT(dal_model_read_file(&model, path, &error) == status && model == NULL);
    CU_ASSERT_STRING_EQUAL(error.message, message);
}

static void test_files(void)
{
    check_file("/nowhere/at-all.yaml", DAL_STATUS_IO, "No such file or directory");
    check_file("/", DAL_STATUS_IO, "Is a directory");
    check_file("/dev/null", DAL_STATUS_SYNTAX, "the file is empty");
    check_file("/dev/zero", DAL_STATUS_TOO_LARGE, "more than 4194304 bytes in a system file");
}

static void test_builtin(void)
{
    dal_model *model;
    dal_error error;
    CU_ASSERT(dal_model_builtin(&model, "chaplygin-slegh", &error) == DAL_STATUS_NAME && !model);
    CU_ASSERT_STRING_EQUAL(error.message,
                           "unknown system 'chaplygin-slegh'; did you mean 'chaplygin-sleigh'?");
    CU_ASSERT(dal_builtin_text("chaplygin-slegh") == NULL);
}

static void test_many(void)
{
    dal_model *model = dal_model_create("many");
    dal_error error;
    char name[16];
    dal_status status = DAL_STATUS_OK;
    for (int i = 0; status == DAL_STATUS_OK && i < 1100; i++) {
        snprintf(name, sizeof name, "q%d", i);
        status = dal_model_add(model, DAL_SECTION_COORDINATES, NULL, name, 0, 0, &error);
    }
    const dal_system *system;
    CU_ASSERT(dal_model_system(model, &system, &error) == DAL_STATUS_TOO_LARGE && system == NULL);
    CU_ASSERT_STRING_EQUAL(error.message, "1100 coordinates; at most 1024 are possible");
    for (int i = 1100; status == DAL_STATUS_OK && i < 5000; i++) {
        snprintf(name, sizeof name, "q%d", i);
        status = dal_model_add(model, DAL_SECTION_COORDINATES, NULL, name, 0, 0, &error);
    }
    CU_ASSERT(status == DAL_STATUS_TOO_LARGE);
    CU_ASSERT_STRING_EQUAL(error.message, "more than 4096 entries");
    dal_model_free(model);
}

void suite_model_errors(void)
{
    CU_pSuite suite = CU_add_suite("model errors", NULL, NULL);
    CU_add_test(suite, "YAML", test_yaml);
    CU_add_test(suite, "names", test_names);
    CU_add_test(suite, "events", test_events);
    CU_add_test(suite, "formulas", test_formulas);
    CU_add_test(suite, "functions", test_functions);
    CU_add_test(suite, "sizes and indices", test_indices);
    CU_add_test(suite, "mechanics", test_mechanics);
    CU_add_test(suite, "quotes", test_quotes);
    CU_add_test(suite, "bytes", test_bytes);
    CU_add_test(suite, "files", test_files);
    CU_add_test(suite, "built-in systems", test_builtin);
    CU_add_test(suite, "too many entries", test_many);
}
