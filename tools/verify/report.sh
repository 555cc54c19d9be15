#!/usr/bin/env bash
# reports of three runs opened in a headless browser: all pictures drawn, nothing loaded
install_packages verify
for deck in ice/shock_tube ice/amr_explosion mpmice/cylinder; do
  name=${deck##*/}
  "$SLUICE" run "$SLUICE_ROOT/inputs/$deck.ups" -o "$PART_DIR" --progress none --max-steps 60 \
    --output-at-end
  "$SLUICE" report "$PART_DIR/$name.uda" -o "$PART_DIR/$name.html"
done
"$PYTHON" "$SLUICE_ROOT/tools/verify/report.py" --folder "$PART_DIR"
