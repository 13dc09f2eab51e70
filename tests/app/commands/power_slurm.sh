#!/bin/bash
# Slurm on this machine alone, by hand and as root: a controller and a node in FOLDER, on ports of
# their own. Runs data/cluster/power.slurm there as data/cluster/README.md says, and ends both.
#   power_slurm.sh FOLDER JND POWER_SLURM OUT [words of `jnd power`]
set -euo pipefail
s=$1 slurm_script=$3 out=$4
export JND=$2 PATH=$PATH:/usr/sbin
shift 4
host=$(hostname -s)
port=$((20000 + $$ % 20000))
pids=()

finish() {
  scancel --name=jnd-power 2>/dev/null || true
  for ((i = ${#pids[@]} - 1; i >= 0; --i)); do
    kill "${pids[i]}" 2>/dev/null || true
    wait "${pids[i]}" 2>/dev/null || true
  done
}

wait_for() {  # until the command succeeds, a minute at most
  for ((i = 0; i < 300; ++i)); do
    if "$@" 2>/dev/null; then return; fi
    sleep 0.2
  done
  echo "never came: $*" >&2
  tail -n 20 "$s"/log/* >&2
  exit 1
}

mkdir -p "$s"/{munge,key,mlog,state,spool,run,log,out}
chmod 755 "$s" "$s/munge"
chmod 700 "$s/key" "$s/mlog"
cat > "$s/slurm.conf" <<CONF
ClusterName=test
SlurmctldHost=$host(127.0.0.1)
SlurmctldPort=$port
SlurmdPort=$((port + 1))
AuthInfo=socket=$s/munge/munge.socket
ProctrackType=proctrack/linuxproc
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
SchedulerParameters=sched_min_interval=0,batch_sched_delay=0
StateSaveLocation=$s/state
SlurmdSpoolDir=$s/spool
SlurmctldPidFile=$s/run/slurmctld.pid
SlurmdPidFile=$s/run/slurmd.pid
SlurmctldLogFile=$s/log/slurmctld.log
SlurmdLogFile=$s/log/slurmd.log
NodeName=$host NodeAddr=127.0.0.1 CPUs=2 RealMemory=2000 State=UNKNOWN
PartitionName=test Nodes=ALL Default=YES State=UP
CONF
export SLURM_CONF=$s/slurm.conf
trap finish EXIT

mungekey --create --keyfile="$s/key/munge.key"
munged -F --key-file="$s/key/munge.key" --socket="$s/munge/munge.socket" \
  --pid-file="$s/munge/munged.pid" --seed-file="$s/mlog/seed" >"$s/log/munged.log" 2>&1 &
pids+=($!)
wait_for test -S "$s/munge/munge.socket"
slurmctld -D >/dev/null 2>&1 &
pids+=($!)
slurmd -D >/dev/null 2>&1 &
pids+=($!)
is_idle() { [[ $(sinfo -h -o %t) == idle ]]; }
wait_for is_idle

cd "$s/out"
array=$(sbatch --parsable --array=1-4 "$slurm_script" "$out" "$@")
if ! timeout 240 sbatch --wait --dependency=afterok:"$array" "$slurm_script" "$out" >/dev/null; then
  echo "the jobs failed" >&2
  cat "$s"/out/slurm-* >&2
  exit 1
fi
