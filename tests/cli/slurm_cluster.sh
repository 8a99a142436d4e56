# SPDX-License-Identifier: Apache-2.0
# Sourced by scripts that need a Slurm cluster: a real slurmctld and two nodes on this machine, without systemd. As root;
# Debian's slurm-wlm and munge. Everything lies in $cluster, a folder of the script's.
#   start_cluster, stop_cluster; node_pid NODE

cluster=$scratch/cluster
SLURM_CONF=$cluster/slurm.conf
export SLURM_CONF

has_slurm() {
    [ "$(id -u)" -eq 0 ] && command -v slurmctld >/dev/null && command -v slurmd >/dev/null && command -v munged >/dev/null
}

write_slurm_conf() {
    port=$((20000 + $$ % 20000))
    cat >"$SLURM_CONF" <<END
ClusterName=srisp
SlurmctldHost=localhost(127.0.0.1)
SlurmctldPort=$port
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=socket=$cluster/munge/socket
StateSaveLocation=$cluster/state
SlurmdSpoolDir=$cluster/spool.%n
SlurmctldPidFile=$cluster/slurmctld.pid
SlurmdPidFile=$cluster/%n.pid
SlurmctldLogFile=$cluster/slurmctld.log
SlurmdLogFile=$cluster/%n.log
ProctrackType=proctrack/pgid
TaskPlugin=task/none
SwitchType=switch/none
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
JobAcctGatherType=jobacct_gather/none
ReturnToService=2
SlurmdTimeout=10
KillWait=2
MinJobAge=600
SchedulerParameters=batch_sched_delay=1,sched_interval=2
NodeName=n1 NodeHostname=localhost NodeAddr=127.0.0.1 Port=$((port + 1)) CPUs=1 RealMemory=500
NodeName=n2 NodeHostname=localhost NodeAddr=127.0.0.1 Port=$((port + 2)) CPUs=1 RealMemory=500
PartitionName=main Nodes=n1,n2 Default=YES MaxTime=60 State=UP
END
}

start_cluster() {
    # munge wants folders that nobody else can write to, up to the root
    chmod 755 "$scratch"
    mkdir -p "$cluster/munge" "$cluster/state"
    chmod 755 "$cluster" "$cluster/munge"
    head -c 1024 /dev/urandom >"$cluster/munge/key"
    chown -R munge: "$cluster/munge"
    chmod 400 "$cluster/munge/key"
    runuser -u munge -- munged --key-file="$cluster/munge/key" --socket="$cluster/munge/socket" \
        --pid-file="$cluster/munge/pid" --log-file="$cluster/munge/log" --seed-file="$cluster/munge/seed" --force || return 1
    write_slurm_conf
    slurmctld -D >/dev/null 2>&1 &
    start_node n1
    start_node n2
    waited=0
    until [ "$(sinfo -h -t idle -o %D 2>/dev/null)" = 2 ]; do
        sleep 0.5
        waited=$((waited + 1))
        [ $waited -lt 60 ] || { tail -n 20 "$cluster"/*.log; return 1; }
    done
}

start_node() { # start_node NODE
    slurmd -D -N "$1" >/dev/null 2>&1 &
}

node_pid() { cat "$cluster/$1.pid"; }

stop_cluster() {
    scancel -u root 2>/dev/null
    for file in "$cluster"/n1.pid "$cluster"/n2.pid "$cluster"/slurmctld.pid "$cluster"/munge/pid; do
        [ -s "$file" ] && kill "$(cat "$file")" 2>/dev/null
    done
    pkill -f "slurmstepd.*$cluster" 2>/dev/null
    true
}
