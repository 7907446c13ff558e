#!/usr/bin/env bash
#SBATCH --job-name=condyle_study
#SBATCH --requeue
#SBATCH --open-mode=append
#SBATCH --output=condyle_%A_%a.log
# The shards of a study as the tasks of a job array, without Snakemake:
#
#   sbatch --array=1-40 --cpus-per-task=2 workflow/slurm_array.sh hips.csv study 40 --band=200
#   condyle merge study
#
# CONDYLE names the command where it is not on the path. A task that a signal ended asks to be run again, three times at most
# (sites with RequeueExit=75; elsewhere submit the array again: only what is missing is done).
set -u
table=$1 out=$2 shards=$3
shift 3
"${CONDYLE:-condyle}" --threads "${SLURM_CPUS_PER_TASK:-1}" study "$table" --out "$out" \
  --shard "$SLURM_ARRAY_TASK_ID/$shards" "$@"
code=$?
if [ "$code" -ge 128 ] && [ "${SLURM_RESTART_COUNT:-0}" -lt 3 ]; then exit 75; fi
exit "$code"
