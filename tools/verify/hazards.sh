#!/usr/bin/env bash
# runs that lose unflushed writes, their folder or memory: archives stay good, ends equal, status 3
status=0 told=()
gcc -O1 -shared -fPIC -o sync_shim.so "$SLUICE_ROOT/tools/verify/sync_shim.c" -ldl
hazards_of() {  # deck, options
  local name
  name=$(basename "$1" .ups)
  "$PYTHON" "$SLUICE_ROOT/tools/verify/hazards.py" --sluice "$SLUICE" --folder "$PART_DIR/$name" \
    --shim "$PART_DIR/sync_shim.so" --deck "$SLUICE_ROOT/inputs/$1" --seed "${HAZARDS_SEED:-1}" \
    --power "${HAZARDS:-30}" --memory "${HAZARDS:-30}" "${@:2}" | tee "$name.told" || status=1
  told+=("$(sed -n 's/^RESULT: //p' "$name.told")")
}
hazards_of ice/amr_explosion.ups --steps 40
hazards_of mpm/colliding_disks.ups --steps 100
hazards_of mpmice/shock_over_foam.ups --steps 30
echo "RESULT: $(IFS=';'; echo "${told[*]}")"
exit "$status"
