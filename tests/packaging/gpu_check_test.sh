# SPDX-License-Identifier: Apache-2.0
# Case run by tests/cases.sh with BIN SOURCE GPU PYTHON. packaging/gpu_check runs with small pictures on PoCL, on
# lavapipe and on a simulated GPU (tests/gpu), whose driver is in the folder GPU. A broken backend, a step that
# hangs and wrong bits must not stop other steps. Results are packed after each step, and tools/gpu_results.py makes a
# page from them.
bin=$1
source=$2
gpu=$3
python=$4

test_gpu_check() {
    cp "$source"/params*.dat .
    mkdir bin gpu-check read
    for program in render bench flythrough imgdiff; do cp "$bin/$program" bin; done
    cp "$source"/packaging/gpu_* gpu-check
    export LD_LIBRARY_PATH=$gpu SIMULATED_CAPABILITY=90 MANDELMARCH_REHEARSAL=1
    unset CUDA_VISIBLE_DEVICES
    export BACKENDS="cuda openacc opencl vulkan"
    printf '#!/bin/sh\nexec sleep 1000\n' >hanging
    chmod +x hanging
    mkdir smi
    printf '#!/bin/sh\necho "Card series: simulated"\n' >smi/rocm-smi
    chmod +x smi/rocm-smi
    # A stand-in for ncu lists the kernels of a picture that its options select. It runs no program.
    cat >smi/ncu <<'END'
#!/bin/bash
while [ "$1" != -k ]; do shift; done
pattern=${2#regex:}
options=" $* "
most=${options##* -c }
printf '"ID","Kernel Name","gpu__time_duration.sum","last"\n"","","ns",""\n'
printf 'mandelmarch_cuda_%s_mandelbulb_float_fast\n' cones draw | grep -E "$pattern" | head -n "${most%% *}" |
    awk '{ printf "\"%d\",\"%s\",\"1,%d00\",\"\"\n", NR - 1, $1, NR }'
END
    chmod +x smi/ncu
    check() { gpu-check/gpu_check "$@" >out 2>&1; }
    results() { tar -xOzf "$1/results.tgz" "results/$2"; }

    # Runs the steps that gpu_check runs without --hour, but with the longer time limits of --hour, because this machine
    # may be busy. Two faults are simulated: gcc's kernels do not link, and ffmpeg hangs.
    quarter="facts cuda openacc opencl vulkan abl-cuda abl-openacc peak t-cuda t-openacc t-opencl t-vulkan warps-cuda warps-openacc ncu-cuda ncu-openacc abl-64 floor unlocked 4k 8k random film"
    PATH=$PWD/smi:$PATH SIMULATED_FAULT=link MANDELMARCH_FFMPEG=$PWD/hanging SECONDS_OF_film=10 check --hour bin out-all $quarter
    [ $? = 1 ] || fail "with a broken backend the exit code is not 1: $(cat out)"
    for step in facts cuda opencl vulkan abl-cuda peak t-cuda t-opencl t-vulkan warps-cuda ncu-cuda abl-64 floor unlocked 4k 8k random; do
        grep -qE "^$step +passed" out-all/summary.txt || fail "$step: $(grep "^$step " out-all/summary.txt) $(results out-all $step.log | tail -5)"
    done
    [ "$(results out-all rocm-smi.txt)" = "Card series: simulated" ] || fail "what rocm-smi says is not recorded"
    grep -qE '^cuda +passed .*same bits in 6 pictures$' out-all/summary.txt || fail "cuda's bits: $(cat out)"
    grep -qE '^ncu-cuda +passed .* 8 tables of counters$' out-all/summary.txt || fail "what ncu counted: $(cat out)"
    results out-all ncu-cuda-bulb-float-draw.csv >log
    [ "$(grep -c mandelmarch_ log)" = 1 ] && grep -q cuda_draw_ log || fail "ncu counts another kernel than the drawing one: $(cat log)"
    results out-all t-cuda.json | "$python" -c '
import json, sys
data = json.load(sys.stdin)
samples = {len(row["samples"]) for row in data["rows"] if row["samples"]}
sys.exit(data["runs"] != 2 or samples != {8} or not data["peaks"])' || fail "the times are not of two runs of four pictures, with peaks"
    grep -qE '^openacc +failed .*last words: libgomp' out-all/summary.txt || fail "the broken backend: $(cat out)"
    grep -qE '^film +late' out-all/summary.txt || fail "the step that hangs: $(cat out)"
    grep -qE '^omptarget|^standard' out-all/summary.txt && fail "a step that was not selected: $(cat out)"
    [ "$(ls out-all)" = "$(printf 'results.tgz\nsummary.txt')" ] || fail "what comes home: $(ls out-all)"
    results out-all driver-openacc.txt >log
    grep -q 'libgomp: cuLinkComplete error' log || fail "the driver's log lacks the failure: $(tail -3 log)"
    pgrep -f "$PWD/hanging" >/dev/null && fail "a step at its limit leaves a process"

    # tools/gpu_results.py makes a page from the results. tests/tools/gpu_results_test.py tests other archives.
    "$python" -B "$source/tools/gpu_results.py" out-all/results.tgz read >page || fail "the reader: $(cat page)"
    in=$(echo read/rehearsal-*)
    for words in '^- Same bits as the host: cuda, opencl, vulkan\.$' '^- openacc: .*last words' '^\| picture \| cuda \|.* vulkan \|$' '^\| mandelbulb float fast \| [0-9]' '^\| first picture \| [0-9]' \
        '^- Step film late' 'A rehearsal'; do
        grep -qE "$words" "$in/README.md" || fail "the page lacks '$words': $(cat "$in/README.md")"
    done

    # Negative control: if the expected hashes are changed, bits differ. Only the named step runs.
    sed -i 's/^./x/' gpu-check/gpu_check.sha256
    check bin out-bits cuda && fail "other bits are not seen"
    grep -qE '^cuda +failed .*OTHER BITS in 6 pictures' out-bits/summary.txt || fail "of other bits it says: $(cat out)"
    [ "$(wc -l <out-bits/summary.txt)" = 1 ] || fail "one step was selected: $(cat out)"
    cp "$source"/packaging/gpu_check.sha256 gpu-check

    # A second run executes only the steps that have not passed yet. If it is stopped, no process remains.
    BACKENDS=vulkan check --work kept bin out-kept facts vulkan || fail "two steps: $(cat out)"
    BACKENDS=vulkan gpu-check/gpu_check --work kept bin out-kept >out 2>&1 &
    for _ in $(seq 300); do grep -q '^t-vulkan' out && break; sleep 0.1; done
    kill $! && wait $!
    [ $? = 130 ] || fail "stopped, it ends with another exit code than 130"
    grep -q '^vulkan: done before' out || fail "it does not go on: $(cat out)"
    for _ in $(seq 200); do pgrep -f "$PWD/bin" >processes || break; sleep 0.1; done
    [ ! -s processes ] || fail "stopped, it leaves $(cat processes)"

    # Invalid arguments are reported in one line.
    check nothing out-none
    [ $? = 2 ] && [ "$(wc -l <out)" = 1 ] && grep -q 'nothing: no such file' out || fail "programs that are missing: $(cat out)"
    BACKENDS=nonsense check bin out-none
    [ $? = 2 ] && grep -q "'nonsense' given, expected some of" out || fail "an unknown backend: $(cat out)"
}
