# Bad input: each is refused with a message that names it, exit 2, and no rows.

# refuse MESSAGE SYSTEM [OPTION]...
refuse() {
    message=$1
    shift
    try 2 run "$@"
    says "^dalembert: .*$message"
    empty
}
# system TEXT: writes bad.yaml.
system() { printf '%s\n' "$@" >bad.yaml; }
run="--integrator rk4 --step 0.1 --time 1"

case_is "steps"
refuse '--step: it must not be 0' chaplygin-sleigh --integrator rk4 --step 0 --time 1
refuse 'step.* -0\.1 ' chaplygin-sleigh --integrator rk4 --step -0.1 --time 1
refuse "step.*'?nan'? is not a number" chaplygin-sleigh --integrator rk4 --step nan --time 1
refuse "step.*'?inf'? is not a number" chaplygin-sleigh --integrator rk4 --step inf --time 1
refuse "step.*'?0\.1x'? is not a number" chaplygin-sleigh --integrator rk4 --step 0.1x --time 1
refuse "step.*'?0,1'? is not a number" chaplygin-sleigh --integrator rk4 --step 0,1 --time 1
refuse '--step: 2 is larger than the time 1' chaplygin-sleigh --integrator rk4 --step 2 --time 1
refuse 'more than can be counted' chaplygin-sleigh --integrator rk4 --step 1e-16 --time 1
refuse 'more than can be counted' chaplygin-sleigh --integrator rk4 --step 1e-300 --times 0,1
refuse 'more than can be counted' chaplygin-sleigh --integrator rk4 --step 1e-300 --time 1 --sampling log

case_is "times and samples"
refuse '--time: a step of 0.1 does not lead from t = 0 to t = 0' chaplygin-sleigh --integrator rk4 --step 0.1 --time 0
refuse '--time: a step of 0.1 does not lead from t = 0 to t = -1' chaplygin-sleigh --integrator rk4 --step 0.1 --time -1
refuse "--time: 'nan' is not a number" chaplygin-sleigh --integrator rk4 --step 0.1 --time nan
refuse "--time: '1e999' is too large" chaplygin-sleigh --integrator rk4 --step 0.1 --time 1e999
refuse '--samples: 0 is not in 1\.\.' chaplygin-sleigh $run --samples 0
refuse '--samples: 1\.5 is not an integer' chaplygin-sleigh $run --samples 1.5
refuse "--samples: 'many' is not a number" chaplygin-sleigh $run --samples many
refuse 'space.*curved.*lifted\|physical' chaplygin-sleigh $run --space curved
refuse 'iterations.*0' chaplygin-sleigh $run --iterations 0

case_is "unknown names"
refuse "unknown system 'chaplygin-slay'; did you mean 'chaplygin-sleigh'\?" chaplygin-slay $run
refuse "'rk5'.*did you mean 'rk4'\?" chaplygin-sleigh --integrator rk5 --step 0.1 --time 1
refuse "'projekt'.*did you mean 'project'\?" chaplygin-sleigh --integrator rk4+projekt --step 0.1 \
    --time 1
refuse "'omege'.*did you mean 'omega'\?" chaplygin-sleigh $run --set omege=1
refuse "'ph'.*did you mean 'phi" chaplygin-sleigh $run --start ph=1
refuse "'pi_ph'.*did you mean 'pi_phi'" chaplygin-sleigh $run --start pi_ph=1
refuse 'p_phi' chaplygin-sleigh $run --space physical --start p_phi=1

case_is "a message is one line, whatever a name holds"
refuse "unknown system 'a\?b\?\[31m'" "$(printf 'a\nb\033[31m')" $run
expect "one line" [ "$(wc -l <err)" -eq 1 ]

case_is "settings"
refuse "--set: 'omega' is not NAME=VALUE" chaplygin-sleigh $run --set omega
refuse "--set: '=1' is not NAME=VALUE" chaplygin-sleigh $run --set =1
refuse "omega=1\+: '1\+' is not a number" chaplygin-sleigh $run --set omega=1+
refuse "omega=nan: 'nan' is not a number" chaplygin-sleigh $run --set omega=nan
refuse "phi=inf: 'inf' is not a number" chaplygin-sleigh $run --start phi=inf

case_is "system files that are not there"
refuse "cannot read 'missing.yaml': No such file" missing.yaml $run
refuse "cannot read '\./missing': No such file" ./missing $run
mkdir -p folder.yaml
refuse "cannot read 'folder.yaml': it is a directory" folder.yaml $run

case_is "malformed YAML"
system 'coordinates: [x' "lagrangian: x'^2/2"
refuse 'bad\.yaml:[0-9]+:[0-9]+: ' bad.yaml $run
: >bad.yaml
refuse 'bad\.yaml' bad.yaml $run

case_is "nesting without end" # at a cost beyond a linear one the program would be ended
for open in '[' '{a: ' '- ' '[\n'; do
    awk -v open="$open" 'BEGIN { for (i = 0; i < 1000000; i++) printf open }' \
        >bad.yaml
    refuse 'bad\.yaml:[0-9]+:[0-9]+: ' bad.yaml $run
    try 2 study bad.yaml --output there
    says '^dalembert: bad\.yaml:[0-9]+:[0-9]+: deeper than 32 levels$'
    mkdir -p deep
    cp bad.yaml deep/manifest.json
    try 2 resume deep
    says '^dalembert: deep/manifest\.json:[0-9]+:[0-9]+: (deeper than 32 levels|no JSON: .*)$'
    cp bad.yaml deep/study.yaml
    try 2 resume deep
    rm -r deep
done

case_is "unknown and duplicate keys"
system 'coordinates: [x]' "lagrangan: x'^2/2"
refuse "bad\.yaml:2:1: .*'lagrangan'.*'lagrangian'" bad.yaml $run
system 'coordinates: [x]' "lagrangian: x'^2/2" "lagrangian: x'^2"
refuse 'bad\.yaml:3:1: .*lagrangian' bad.yaml $run

case_is "formulas"
system 'coordinates: [x]' "lagrangian: x'^2/2 - spring*x^2"
refuse "bad\.yaml:2:22: .*'spring'" bad.yaml $run
system 'coordinates: [x]' "lagrangian: (x'^2/2"
refuse 'bad\.yaml:2:[0-9]+: ' bad.yaml $run
system 'coordinates: [x]' "lagrangian: x'^2/2)"
refuse 'bad\.yaml:2:19: ' bad.yaml $run
system 'coordinates: [x]' "lagrangian: x'^2/2 + 2x"
refuse 'bad\.yaml:2:2[2-3]: ' bad.yaml $run
system 'coordinates: [x]' 'lagrangian: ""'
refuse 'bad\.yaml:2:1[2-4]: .*empty' bad.yaml $run
system 'coordinates: [x]' "lagrangian: x'^2/0"
refuse 'bad\.yaml:2:1[3-9]: .*zero' bad.yaml $run

case_is "coordinates"
system 'coordinates: []' 'lagrangian: 1'
refuse 'bad\.yaml.*coordinate' bad.yaml $run
system 'coordinates: [x, x]' "lagrangian: x'^2/2"
refuse "bad\.yaml:1:18: .*'x'" bad.yaml $run

case_is "a start off the constraint"
refuse "constraint 1" chaplygin-sleigh $run --start "y2'=0.5"
refuse "constraint 1" chaplygin-sleigh $run --start "y2'=1e-9"
try 0 run chaplygin-sleigh $run --start "y2'=1e-11"

case_is "constraints that depend on each other"
system 'coordinates: [x, y]' "lagrangian: (x'^2 + y'^2)/2" "constraints: [x' - y', 2*x' - 2*y']"
refuse 'rank|depend' bad.yaml $run

case_is "an integrator that cannot act"
refuse 'lifted space' chaplygin-sleigh-vakonomic $run --space lifted
