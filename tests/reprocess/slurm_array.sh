#!/usr/bin/env bash
# Runs COMMAND as an array of three tasks on a Slurm of this machine alone: slurm_array.sh FOLDER COMMAND.
# Exit code 77: Slurm does not start here.
set -euo pipefail
folder=$1
command=$2

mkdir -p "$folder"/{state,spool}
chmod 755 "$folder"
port=$((20000 + $$ % 20000))
stop() {
  for daemon in slurmd slurmctld munged; do
    [[ -s $folder/$daemon.pid ]] && kill "$(<"$folder/$daemon.pid")" 2>/dev/null || true
  done
}
trap stop EXIT

head -c 1024 /dev/urandom >"$folder/munge.key"
chmod 600 "$folder/munge.key"
munged --force --key-file="$folder/munge.key" --socket="$folder/munge.socket" --pid-file="$folder/munged.pid" \
  --log-file="$folder/munged.log" --seed-file="$folder/munge.seed" || exit 77

host=$(hostname -s)
cat >"$folder/slurm.conf" <<END
ClusterName=test
SlurmctldHost=$host(127.0.0.1)
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=socket=$folder/munge.socket
MpiDefault=none
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SchedulerParameters=sched_interval=1,batch_sched_delay=0
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
StateSaveLocation=$folder/state
SlurmdSpoolDir=$folder/spool
SlurmctldPidFile=$folder/slurmctld.pid
SlurmdPidFile=$folder/slurmd.pid
SlurmctldLogFile=$folder/slurmctld.log
SlurmdLogFile=$folder/slurmd.log
SlurmctldPort=$port
SlurmdPort=$((port + 1))
NodeName=$host NodeAddr=127.0.0.1 CPUs=$(nproc) State=UNKNOWN
PartitionName=test Nodes=$host Default=YES State=UP
END
export SLURM_CONF=$folder/slurm.conf
slurmctld -i -c || exit 77
slurmd -c || exit 77
for ((i = 0; i < 30; ++i)); do
  sinfo -h -o %T 2>/dev/null | grep -q idle && break
  sleep 1
done
((i < 30)) || exit 77

timeout 120 sbatch --wait --array=3-7:2 --output="$folder/task.%a" --wrap "$command"
