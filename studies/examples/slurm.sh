#!/bin/bash
# A study over several nodes of a cluster that runs Slurm: eight processes of four threads. The program must have been
# built with -DBELTLIFE_MPI=ON on the cluster, with the MPI that its srun starts (pmix for Open MPI), and the files must
# lie where all nodes see them. A job that was killed, requeued or out of time goes on where it was: the same command
# goes on from the log.
#   sbatch studies/examples/slurm.sh studies/examples/sobol.toml sobol.h5
#SBATCH --job-name=beltlife
#SBATCH --ntasks=8
#SBATCH --cpus-per-task=4
#SBATCH --time=04:00:00
#SBATCH --requeue
#SBATCH --open-mode=append
set -euo pipefail
study=${1:-studies/examples/sobol.toml}
out=${2:-sobol.h5}

srun --mpi=pmix --cpus-per-task="$SLURM_CPUS_PER_TASK" --cpu-bind=cores \
  beltlife study sobol "$study" --threads "$SLURM_CPUS_PER_TASK" --out "$out"
