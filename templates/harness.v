// A harness for placement and routing: the unit has more ports than the part has pins. Inputs are shifted in while
// `shift` is set, which keeps them from merging with the unit's own registers; outputs are caught and shifted out.
module {{ name }} (
  input clk,
  input shift,
  input serial,
  input capture,
  output folded
);
  reg [{{ input_high }}:0] given;
  wire [{{ output_high }}:0] result;
  reg [{{ output_high }}:0] answer;

  always @(posedge clk) begin
    if (shift)
      given <= {given, serial};
    if (capture)
      answer <= result;
    else
      answer <= answer >> 1;
  end
  assign folded = answer[0];

  {{ top }} {{ instance }} (
{%- for port in inputs %}
    .{{ port.name }}(given[{{ port.high }}:{{ port.low }}]),
{%- endfor %}
{%- for port in outputs %}
    .{{ port.name }}(result[{{ port.high }}:{{ port.low }}]),
{%- endfor %}
    .{{ clock }}(clk)
  );
endmodule
