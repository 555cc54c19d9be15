#!/usr/bin/env bash
# exports and fields.xmf in Debian's headless ParaView: every number read back, picture drawn
install_packages test
install_packages verify
status=0 told=()
archive_of() {  # report
  "$PYTHON" -c 'import json, sys; print(json.load(open(sys.argv[1]))["archive"])' "$1"
}
under_a_screen() {
  LIBGL_ALWAYS_SOFTWARE=1 xvfb-run -a --wait=10 -s "-screen 0 1024x768x24 -noreset" "$@"
}
"$SLUICE" run "$SLUICE_ROOT/inputs/ice/blast_2d.ups" -o "$PART_DIR" --progress none \
  --json "$PART_DIR/report.json" --set 'Grid/Level/Box/resolution=[64,64,1]'
archive=$(archive_of "$PART_DIR/report.json")
"$SLUICE" export "$archive" -o "$PART_DIR/export"
"$SLUICE" extract "$archive" --var press_CC --csv "$PART_DIR/press.csv"
under_a_screen "$PYTHON" "$SLUICE_ROOT/tools/verify/render.py" --export "$PART_DIR/export" \
  --csv "$PART_DIR/press.csv" --picture "$PART_DIR/paraview.png" | tee render.told || status=1
told+=("$(sed -n 's/^RESULT: //p' render.told)")

# Levels, particles, several ranks: every number through the link and through an export.
read_back() {  # ranks, deck, settings
  local name
  name=$(basename "$2" .ups)
  mpiexec --allow-run-as-root --oversubscribe -np "$1" "$SLUICE" run "$SLUICE_ROOT/inputs/$2" \
    -o "$PART_DIR/$name" --progress none --json "$PART_DIR/$name.json" "${@:3}" >"$name.log"
  local made folder=$PART_DIR/$name.vtk
  archive=$(archive_of "$PART_DIR/$name.json")
  made=$("$SLUICE" export "$archive" -o "$folder")
  under_a_screen "$PYTHON" -B "$SLUICE_ROOT/tools/verify_link.py" "$archive" --paraview |
    tee "$name.told" || status=1
  under_a_screen "$PYTHON" -B "$SLUICE_ROOT/tools/verify_export.py" "$archive" "$made" \
    --paraview | tee -a "$name.told" || status=1
  local outputs written
  outputs=$(du -sbc "$archive"/t[0-9]* | tail -1 | cut -f1)
  written=$(du -sb "$folder" | cut -f1)
  told+=("$name: $(sed 's/^verify_//' "$name.told" | paste -sd, -)")
  told+=("$name: the export takes $((100 * written / outputs)) % of the outputs")
}
read_back 2 ice/amr_explosion.ups
read_back 2 mpmice/foam_on_levels.ups --set 'Grid/Level[1]/Box/resolution=[40,40,1]' \
  --set 'Grid/Level[2]/Box/resolution=[56,48,1]' --set Time/max_Timesteps=20
read_back 1 mpm/colliding_disks.ups --set Time/max_Timesteps=50
echo "RESULT: $(IFS=';'; echo "${told[*]}")"
exit "$status"
