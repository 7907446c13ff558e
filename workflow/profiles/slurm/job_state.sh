#!/usr/bin/env bash
# The state of a Slurm job, in Snakemake's words. Of a job that the controller has forgotten nothing is known: it counts as
# failed and is tried again, which costs nothing where its shard was done.
set -euo pipefail
state=$(scontrol --oneliner show job "$1" 2>/dev/null | sed -nE 's/.* JobState=([A-Z_]+).*/\1/p' || true)
case $state in
  COMPLETED) echo success ;;
  PENDING | CONFIGURING | RUNNING | COMPLETING | SUSPENDED | REQUEUED | REQUEUE_HOLD | NODE_FAIL | PREEMPTED | STOPPED)
    # With --requeue a job of a lost node waits and runs again.
    echo running ;;
  *) echo failed ;;
esac
