// MULT18X18D of the ECP5 for simulation, as far as efsat uses it: a product of 18 x 18 bits, each operand signed
// or not, and registers behind it and in front of each operand, or none. A netlist that asks for others is refused;
// SOURCEA, SOURCEB and C are taken to be 0.
// P = A B; with REG_OUTPUT_CLK = "CLK0" one clock later, zero after a clock with RST0, held while CE0 is clear; A and B
// in the same way with REG_INPUTA_CLK and REG_INPUTB_CLK. All begin with zero.
module MULT18X18D (
    input A0, A1, A2, A3, A4, A5, A6, A7, A8, A9, A10, A11, A12, A13, A14, A15, A16, A17,
    input B0, B1, B2, B3, B4, B5, B6, B7, B8, B9, B10, B11, B12, B13, B14, B15, B16, B17,
    input C0, C1, C2, C3, C4, C5, C6, C7, C8, C9, C10, C11, C12, C13, C14, C15, C16, C17,
    input SIGNEDA, SIGNEDB, SOURCEA, SOURCEB, CLK0, CE0, RST0,
    output P0, P1, P2, P3, P4, P5, P6, P7, P8, P9, P10, P11, P12, P13, P14, P15, P16, P17, P18, P19, P20, P21,
        P22, P23, P24, P25, P26, P27, P28, P29, P30, P31, P32, P33, P34, P35
);
    parameter REG_INPUTA_CLK = "NONE";
    parameter REG_INPUTB_CLK = "NONE";
    parameter REG_INPUTA_CE = "CE0";
    parameter REG_INPUTB_CE = "CE0";
    parameter REG_INPUTA_RST = "RST0";
    parameter REG_INPUTB_RST = "RST0";
    parameter REG_INPUTC_CLK = "NONE";
    parameter REG_PIPELINE_CLK = "NONE";
    parameter REG_OUTPUT_CLK = "NONE";
    parameter REG_OUTPUT_CE = "CE0";
    parameter REG_OUTPUT_RST = "RST0";

    wire [17:0] given_a = {A17, A16, A15, A14, A13, A12, A11, A10, A9, A8, A7, A6, A5, A4, A3, A2, A1, A0};
    wire [17:0] given_b = {B17, B16, B15, B14, B13, B12, B11, B10, B9, B8, B7, B6, B5, B4, B3, B2, B1, B0};
    wire [17:0] a, b;
    wire signed [18:0] signed_a = {SIGNEDA & a[17], a};
    wire signed [18:0] signed_b = {SIGNEDB & b[17], b};
    wire signed [37:0] product = signed_a * signed_b;
    wire [35:0] p;
    assign {P35, P34, P33, P32, P31, P30, P29, P28, P27, P26, P25, P24, P23, P22, P21, P20, P19, P18, P17,
        P16, P15, P14, P13, P12, P11, P10, P9, P8, P7, P6, P5, P4, P3, P2, P1, P0} = p;

    generate
        if (REG_INPUTA_CLK == "CLK0") begin
            reg [17:0] register_a = 18'd0;
            always @(posedge CLK0)
                if (RST0) register_a <= 18'd0;
                else if (CE0) register_a <= given_a;
            assign a = register_a;
        end else
            assign a = given_a;
        if (REG_INPUTB_CLK == "CLK0") begin
            reg [17:0] register_b = 18'd0;
            always @(posedge CLK0)
                if (RST0) register_b <= 18'd0;
                else if (CE0) register_b <= given_b;
            assign b = register_b;
        end else
            assign b = given_b;
        if ((REG_INPUTA_CLK != "NONE" && REG_INPUTA_CLK != "CLK0") || (REG_INPUTB_CLK != "NONE" && REG_INPUTB_CLK != "CLK0")
            || REG_INPUTA_CE != "CE0" || REG_INPUTB_CE != "CE0" || REG_INPUTA_RST != "RST0" || REG_INPUTB_RST != "RST0"
            || REG_INPUTC_CLK != "NONE" || REG_PIPELINE_CLK != "NONE" || REG_OUTPUT_CE != "CE0" || REG_OUTPUT_RST != "RST0")
            MULT18X18D_with_other_registers not_modelled ();
        else if (REG_OUTPUT_CLK == "CLK0") begin
            reg [35:0] register;
            always @(posedge CLK0)
                if (RST0) register <= 36'd0;
                else if (CE0) register <= product[35:0];
            assign p = register;
        end else if (REG_OUTPUT_CLK == "NONE")
            assign p = product[35:0];
        else
            MULT18X18D_with_other_registers not_modelled ();
    endgenerate
endmodule
