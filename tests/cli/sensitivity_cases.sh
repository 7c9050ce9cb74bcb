# --sensitivities: columns of derivatives by starts and parameters, closed forms, resumed runs, what is refused.

printf '%s\n' 'coordinates: [x]' 'parameters: {k: 2, a: 1, g: 3}' 'accelerations: {x: k}' 'start: {x: a^2}' >fall.yaml
header() { head -1 out; }
# holds FORMULA: in each row, of which t is the first column.
holds() { awk -F, 'NR > 1 && ('"$1"')^2 > 1e-26 { bad = 1 } END { exit bad || NR < 2 }' out; }
fall="run fall.yaml --integrator rk4 --step 0.125 --time 2 --samples 7 --output -"

case_is "sensitivities: of a fall, closed form"
try 0 $fall --sensitivities "k,a,x'" --columns sensitivities
expect "header" [ "$(header)" = "t,dx/dk,dx'/dk,dx/da,dx'/da,dx/dx',dx'/dx'" ]
expect "dx/dk is not t^2/2" holds '$2 - $1^2/2'
expect "dx'/dk is not t" holds '$3 - $1'
expect "dx/da is not 2a" holds '$4 - 2'
expect "dx/dx' is not t" holds '$6 - $1'
try 0 $fall --sensitivities x --names plain --columns "dvx/*"
expect "plain names" [ "$(header)" = "t,dvx/dx" ]
try 0 $fall --sensitivities a --start x=3
expect "a start that is set depends on nothing" holds '$(NF - 1)'
try 0 $fall --from 1 --sensitivities k --columns sensitivities
expect "dx/dk is not (t - 1)^2/2" holds '$2 - ($1 - 1)^2/2'

case_is "sensitivities: off p = pi = 0 of the whole state"
try 0 $fall --sensitivities pi_x --columns sensitivities --start e=2
expect "header" [ "$(header)" = "t,dx/dpi_x,dx'/dpi_x,de/dpi_x,dp_x/dpi_x,dpi_x/dpi_x,dpi_e/dpi_x" ]
expect "dx/dpi_x is not t^2/(2e)" holds '$2 - $1^2/4'

# e = 1 + t, pi = 1: x' ' = k + 1/e, and dx'/dpi is the integral of 1/e.
case_is "sensitivities: e that changes with t"
try 0 run fall.yaml --integrator gauss8 --step 0.125 --time 2 --samples 7 --output - --sensitivities pi_x \
    --columns sensitivities --gauge mu_e=1 --start e=1
expect "dx'/dpi_x is not ln(1 + t)" holds '($3 - log(1 + $1)) / 100'

case_is "sensitivities: the run keeps its bits"
try 0 $fall
mv out plain
try 0 $fall --sensitivities k
expect "other rows" [ "$(cut -d, -f1-8 out)" = "$(cut -d, -f1-8 plain)" ]

case_is "sensitivities: resumed"
sleigh() { try 0 run chaplygin-sleigh-offset --integrator gauss4 --step 0.03 --sensitivities "a,phi'" "$@"; }
sleigh --time 0.9 --samples 30 --output short
try 0 resume short --time 1.8
sleigh --time 1.8 --samples 60 --output long
expect "other rows" cmp short/trajectory.npy long/trajectory.npy
expect "the manifest names them" grep -q '"sensitivities": "a,phi'"'" long/manifest.json

case_is "sensitivities: killed and resumed"
if needs 12 "no compiler for signals at given places" raises; then
    for call in 2 4 6; do
        cut_off 137 9 $call run chaplygin-sleigh-offset --integrator gauss4 --step 0.03 \
            --sensitivities "a,phi'" --time 1.8 --samples 60 --output killed --checkpoint 0
        refute "call $call: it was not cut off" cmp -s killed/trajectory.npy long/trajectory.npy
        try 0 resume killed
        expect "call $call: other rows" cmp killed/trajectory.npy long/trajectory.npy
        rm -r killed
    done
    counted
fi

case_is "sensitivities: what is refused"
table <<'END'
2 | run fall.yaml --integrator rk4 --step 0.1 --time 1 --sensitivities y | says --sensitivities: unknown parameter 'y'
2 | run fall.yaml --integrator rk4 --step 0.1 --time 1 --sensitivities , | says --sensitivities: the list is empty
2 | run fall.yaml --integrator rk4 --step 0.1 --time 1 --sensitivities e | says constant e
2 | run fall.yaml --integrator taylor --tolerance 1e-9 --time 1 --sensitivities k | says a tolerance divides its step
2 | run fall.yaml --integrator rk4 --step 0.1 --time 1 --sensitivities pi_x --gauge mu_e=0.1*x | says mu_e of the gauge is not of t alone
2 | run chaplygin-sleigh --integrator rk4+project --step 0.1 --time 1 --sensitivities m | says no exact tangent
END

# x = 0, and the derivative grows by 1 + 1 + 1/2 + 1/6 + 1/24 a step: 2.708^711 is 10^307.7 and the sum in the next
# step is 6 times 2.708^712.
case_is "sensitivities: one that becomes too large"
printf "coordinates: [x]\nparameters: {k: 0}\naccelerations: {x: x + k}\n" >still.yaml
try 0 run still.yaml --integrator rk4 --step 1 --time 800 --samples 800
try 3 run still.yaml --integrator rk4 --step 1 --time 800 --samples 800 --sensitivities k
says '^dalembert: still.yaml: a value is not finite at t = 71[1-4]$'
expect "not the rows before" [ "$(wc -l <out)" -ge 711 -a "$(wc -l <out)" -le 716 ]
