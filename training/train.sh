#!/usr/bin/env bash
# Train the shipped classifiers of parts and motions, from archives to .npz: training/train.sh ARTICRAFT INFINIGEN WORK
# ARTICRAFT, INFINIGEN: folders of labelled objects. WORK: for objects and rows; what is there is not computed again. Needs
# lightgbm, torch and the packages of the small sets (training/README.md); about a day of two cores, an estimate. The shipped files
# are of nearly these rows: of robosuite's robots without gr1 and tiago, 26 fused objects of Infinigen-Sim in the motions.
set -euo pipefail
[ $# -eq 3 ] || { sed -n '2,5s/^# //p' "$0"; exit 2; }
cd "$(dirname "$0")/.."
articraft=labelled:$1@articraft infinigen=labelled:$2@infinigen work=$3
own="urdf:$work/kinds@kinds static:$work/kinds@kinds"
small="sweethome3d metaworld libero examples scene-synthesizer"
robots=$(python -c "import importlib.util as u; print(u.find_spec('robosuite').submodule_search_locations[0])")/models/assets
export OMP_NUM_THREADS=1
mkdir -p "$work"
[ -d "$work/kinds" ] || python -m training.kinds "$work/kinds" --seed 11 --count 6
[ -d "$work/held_out/real" ] || python -m benchmarks.held_out "$work/held_out" --still

parts() { python -m training.part_rows "$work/parts" "$@"; }
parts $articraft $infinigen $small $own "static:$work/held_out/real@still"
parts $articraft --change tight --most 240
parts $articraft --change fused --most 100
for change in detailed furnished misplaced; do parts $articraft --change $change --most 40; done
parts "urdf:$work/kinds@kinds" --change tight --most 200
for change in misplaced detailed; do parts "urdf:$work/kinds@kinds" --change $change --most 120; done
parts "urdf:$work/kinds@kinds" --change furnished --most 60
for change in misplaced detailed furnished; do parts $infinigen sweethome3d --change $change --most 32; done
parts $infinigen --change fused --most 40
parts sweethome3d --change fused --most 12
python -m training.train_parts "$work/parts" --write

motions() { python -m training.motion_rows "$work/motions" "$@"; }
motions $articraft $infinigen $small "mjcf:$robots/robots@robosuite" "mjcf:$robots/grippers@robosuite"
motions "urdf:$work/kinds@kinds" --most 300
motions $infinigen --change fused --most 40
python -m training.train_motions "$work/motions" --write

python -m training.learning_curve "$work/parts"
python -m training.learning_curve "$work/parts" --ablation
python -m benchmarks.precision "labelled:$1" --validation 2
