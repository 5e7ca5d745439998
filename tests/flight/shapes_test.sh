#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# shapes_test.sh FLYTHROUGH SOURCE: shapes that cannot be flown through are refused before planning, whatever input they
# come from.
source=$(realpath "$2")
. "$(dirname "$0")/films.sh"
refused() { run 2 "$@" --output new.json; }
params() { sed "s/^2 0.5 1$/$1/" "$source/paramsBox.dat"; }
for scale in 0.5 0.9 0.3 -0.5 -1; do
    params "$scale 0.5 1" >p.dat
    refused plan --frames 120 --fractal box --params p.dat
    says "p.dat: a mandelbox with scale $scale cannot be flown through, expected another scale"
    refused plan --frames 120 --fractal box --scale "$scale"
    says "^--scale: '$scale': .*cannot be flown through"
    refused film --frames 120 --fractal box --scale "2:$scale"
done
refused film --frames 120 --fractal box --params p.dat
for power in 0.5 1 1.1 1.2; do
    sed "s/^0 4.0 8.0$/0 4.0 $power/" "$source/paramsBulb.dat" >p.dat
    refused plan --frames 120 --params p.dat
    says "a mandelbulb with power $power cannot be flown through, expected another power, 8, say"
    refused plan --frames 120 --power "$power"
    refused plan --frames 120 --power "8:$power"
done
# A number on the command line replaces that of the parameter file.
run 0 plan --frames 120 --params p.dat --power 8
# If a Mandelbox's file is read as a Mandelbulb's, there is a warning about the file before the shape is refused.
timeout 30 "$program" plan --frames 120 --params "$source/paramsBox.dat" --output new.json >stdout 2>stderr
[ $? = 2 ] || fail "paramsBox.dat for a Mandelbulb: $(cat stderr)"
says 'warning: these comments suit a mandelbox'
says 'with power 1 cannot be flown through'

# If no flight is found, the message says what is missing and what helps, in the same words for every seed.
for seed in 1 2; do
    timeout 100 "$program" plan --fractal julia --params "$source/paramsJulia.dat" --frames 120 --seed $seed \
        --output new.json >stdout 2>stderr
    [ $? = 2 ] || fail "a Julia set: $(tail -1 stderr)"
    tail -1 stderr | grep -Eq 'this julia has no .*; another seed does not help, expected another shape' || fail "$(tail -1 stderr)"
done
finish
