# A sweep in shards: docs/sweeps.md, "Shards".
#
#   snakemake --snakefile workflow/sweep.smk --profile workflow/profiles/local \
#             --config joint=thr/hip.toml vary="cup.inclination=30:60:1 cup.anteversion=-20:44:1" targets=daily.csv out=zone shards=8
#
# A shard that was done with the same inputs, options and version is not done again, whoever asks.
from shlex import quote

JOINT, VARY, TARGETS = config["joint"], config["vary"], config["targets"]
OUT, SHARDS = config["out"], int(config["shards"])
CONDYLE, OPTIONS = config.get("condyle", "condyle"), config.get("options", "")


localrules: all, merge


rule all:
    input:
        f"{OUT}/sweep.json",


rule shard:
    input:
        joint=JOINT, targets=TARGETS,
    output:
        f"{OUT}/shards/{{i}}_of_{SHARDS}/sweep.json",
    threads: int(config.get("threads", 2))
    resources:
        mem_mb=int(config.get("mem_mb", 2000)),
    retries: int(config.get("retries", 3))
    params:
        condyle=quote(CONDYLE), joint=quote(JOINT), vary=quote(VARY), targets=quote(TARGETS), out=quote(OUT), options=OPTIONS,
    shell:
        # One process, which takes the signals of the scheduler itself.
        "exec {params.condyle} --threads {threads} sweep {params.joint} --vary {params.vary} --targets {params.targets} "
        "--out {params.out} --shard {wildcards.i}/" + str(SHARDS) + " {params.options}"


rule merge:
    input:
        expand(f"{OUT}/shards/{{i}}_of_{SHARDS}/sweep.json", i=range(1, SHARDS + 1)),
    output:
        f"{OUT}/sweep.json",
    params:
        condyle=quote(CONDYLE), out=quote(OUT),
    shell:
        "{params.condyle} merge {params.out}"
