# SPDX-License-Identifier: Apache-2.0
# Sourced by scripts that need a Slurm cluster: a real slurmctld and two nodes on this machine, without systemd. As root;
# Debian's slurm-wlm and munge. Everything lies in $cluster, a folder of the script's.
#   start_cluster, stop_cluster; start_node, lose_node NODE; wait_for SECONDS COMMAND…

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
AuthInfo=socket=$cluster/munge/socket,cred_expire=10
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
BatchStartTimeout=1
SlurmdTimeout=6
KillWait=2
MinJobAge=600
SchedulerParameters=batch_sched_delay=1,sched_interval=2
NodeName=n1 NodeHostname=localhost NodeAddr=127.0.0.1 Port=$((port + 1)) CPUs=1 RealMemory=500
NodeName=n2 NodeHostname=localhost NodeAddr=127.0.0.1 Port=$((port + 2)) CPUs=1 RealMemory=500
PartitionName=main Nodes=n1,n2 Default=YES MaxTime=INFINITE State=UP
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
    wait_for 30 all_idle || { cat "$cluster"/*.log; return 1; }
}
all_idle() { [ "$(sinfo -h -t idle -o %D 2>/dev/null)" = 2 ]; }

start_node() { # start_node NODE
    slurmd -D -N "$1" >/dev/null 2>&1 &
}

lose_node() { # lose_node NODE: as if its power went
    kill -9 "$(cat "$cluster/$1.pid")"
    of_node=$(grep -lzF "SLURMD_NODENAME=$1" /proc/[0-9]*/environ 2>/dev/null | cut -d / -f 3)
    for process in $of_node; do # first what would tell the controller that they ended
        parent=$(cut -d ' ' -f 4 "/proc/$process/stat" 2>/dev/null)
        case $(cat "/proc/$parent/comm" 2>/dev/null) in slurmstepd*) kill -9 "$parent" ;; esac
    done
    for process in $of_node; do kill -9 "$process" 2>/dev/null; done
    true
}

wait_for() { # wait_for SECONDS COMMAND…: until it succeeds
    left=$(($1 * 2))
    shift
    until "$@"; do
        sleep 0.5
        left=$((left - 1))
        [ $left -gt 0 ] || { echo "in vain: $*"; return 1; }
    done
}

stop_cluster() {
    scancel -u root 2>/dev/null
    for file in "$cluster"/n1.pid "$cluster"/n2.pid "$cluster"/slurmctld.pid "$cluster"/munge/pid; do
        [ -s "$file" ] && kill "$(cat "$file")" 2>/dev/null
    done
    pkill -f "slurmstepd.*$cluster" 2>/dev/null
    true
}
