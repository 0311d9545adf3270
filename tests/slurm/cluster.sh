#!/usr/bin/env bash
# A SLURM cluster of one node, this machine, from Debian's packages slurm-wlm and munge; needs root. Its files are in a folder
# of its own but for the configuration, which jobs look for in one place. A machine that has one already is left alone.
#   tests/slurm/cluster.sh start FOLDER
#   tests/slurm/cluster.sh stop FOLDER
set -euo pipefail

action=$1
folder=$(realpath "$2")
configuration=/etc/slurm/slurm.conf

start() {
    if [ -e "$configuration" ]; then
        echo "$configuration is there already: this machine has a SLURM of its own" >&2
        return 1
    fi
    mkdir -p "$folder"/{state,spool,munge}
    chmod 700 "$folder/munge"
    dd if=/dev/urandom of="$folder/munge/key" bs=1024 count=1 status=none
    chmod 400 "$folder/munge/key"
    munged --force --key-file "$folder/munge/key" --socket "$folder/munge/socket" --pid-file "$folder/munge/pid" \
        --seed-file "$folder/munge/seed" --log-file "$folder/munge/log"
    local name memory
    name=$(hostname -s)
    memory=$(awk '/MemTotal/ {print int($2 / 1024 * 0.9)}' /proc/meminfo)
    cat >"$configuration" <<END
ClusterName=one
SlurmctldHost=$name(127.0.0.1)
SlurmctldPort=16817
SlurmdPort=16818
SlurmUser=root
AuthType=auth/munge
AuthInfo=socket=$folder/munge/socket
CryptoType=crypto/munge
StateSaveLocation=$folder/state
SlurmdSpoolDir=$folder/spool
SlurmctldPidFile=$folder/slurmctld.pid
SlurmdPidFile=$folder/slurmd.pid
SlurmctldLogFile=$folder/slurmctld.log
SlurmdLogFile=$folder/slurmd.log
ProctrackType=proctrack/pgid
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core_Memory
ReturnToService=2
MinJobAge=600
SchedulerParameters=sched_interval=1,batch_sched_delay=0,defer_batch
NodeName=$name NodeAddr=127.0.0.1 CPUs=$(nproc) RealMemory=$memory State=UNKNOWN
PartitionName=all Nodes=$name Default=YES MaxTime=INFINITE State=UP
END
    touch "$folder/started"
    slurmctld
    slurmd
    for _ in $(seq 60); do
        if sinfo --noheader --format %T | grep -q idle; then
            return 0
        fi
        sleep 0.5
    done
    echo "the node never became idle; see $folder/*.log" >&2
    return 1
}

stop() {
    local pid
    for pid in slurmd.pid slurmctld.pid munge/pid; do
        if [ -f "$folder/$pid" ]; then
            kill "$(cat "$folder/$pid")"
        fi
    done
    if [ -e "$folder/started" ]; then
        rm "$configuration" "$folder/started"
    fi
}

"$action"
