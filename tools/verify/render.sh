#!/usr/bin/env bash
# an exported run opened in Debian's headless ParaView: numbers read back, picture drawn
install_packages test
install_packages verify
"$SLUICE" run "$SLUICE_ROOT/inputs/ice/blast_2d.ups" -o "$PART_DIR" --progress none \
  --json "$PART_DIR/report.json" --set 'Grid/Level/Box/resolution=[64,64,1]'
archive=$("$PYTHON" -c 'import json, sys; print(json.load(open(sys.argv[1]))["archive"])' \
  "$PART_DIR/report.json")
"$SLUICE" export "$archive" -o "$PART_DIR/export"
"$SLUICE" extract "$archive" --var press_CC --csv "$PART_DIR/press.csv"
LIBGL_ALWAYS_SOFTWARE=1 xvfb-run -a --wait=10 -s "-screen 0 1024x768x24 -noreset" \
  "$PYTHON" "$SLUICE_ROOT/tools/verify/render.py" --export "$PART_DIR/export" \
  --csv "$PART_DIR/press.csv" --picture "$PART_DIR/paraview.png"
