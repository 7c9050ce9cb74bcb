"""dirac-svg.py RESULTS.json - draws the chain of `dalembert dirac --json` as SVG on standard output, by dot.

Constraints are boxes, a column a stage; an arrow leads from a constraint to what its conservation requires, and to
the multiplier that it fixes.
"""
import json
import subprocess
import sys


def group(name):
    """A name without its coordinate: pi_lambda_x and pi_lambda_y are one box."""
    for head in ('pi_lambda', 'mu_lambda', 'lambda', 'pi_e', 'mu_e', 'pi', 'p', 'mu'):
        if name == head or name.startswith(head + '_'):
            return {'p': 'p - lambda', 'mu': 'mu'}.get(head, head)
    return name


def main():
    with open(sys.argv[1], encoding='utf-8') as file:
        chain = json.load(file)
    stages, edges, fixed = {}, {}, {}
    for constraint in chain['constraints']:
        stages.setdefault(group(constraint['formula']), (constraint['stage'], constraint['class']))
        if constraint['from']:
            edges[group(constraint['from']), group(constraint['formula'])] = ''
    for step in chain['steps']:
        if step['outcome'] == 'irregular':
            edges = {pair: 'irregular' if pair[0] == group(step['constraint']) else label
                     for pair, label in edges.items()}
        if step['multiplier']:
            fixed[group(step['constraint']), group(step['multiplier'])] = ''
    values = {'mu': "mu = q'", 'mu_lambda': 'mu_lambda = 0', 'mu_e': 'mu_e is free'}
    lines = ['digraph { rankdir=LR; node [shape=box, fontname="sans-serif", fontsize=12];',
             'edge [fontname="sans-serif", fontsize=10];']
    for name, (_, kind) in stages.items():
        lines.append(f'"{name}" [label="{name} = 0\\n{kind} class"];')
    for stage in sorted({stage for stage, _ in stages.values()}):
        same = '; '.join(f'"{name}"' for name, (at, _) in stages.items() if at == stage)
        lines.append(f'{{ rank=same; {same} }}')
    lines += [f'"{a}" -> "{b}" [label="{label}"];' for (a, b), label in edges.items()]
    for name in dict.fromkeys(b for _, b in fixed):
        lines.append(f'"{name}" [label="{values.get(name, name)}", shape=plaintext];')
    lines += [f'"{a}" -> "{b}" [style=dashed];' for a, b in fixed]
    lines.append('"mu_e" [label="mu_e is free", shape=plaintext]; "pi_e" -> "mu_e" [style=dotted]; }')
    subprocess.run(['dot', '-Tsvg', '-Gbgcolor=transparent'], input='\n'.join(lines), text=True, check=True)


if __name__ == '__main__':
    main()
