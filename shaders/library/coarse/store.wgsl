// A row of the coarse pressure matrix, and what a smoothing step multiplies with.

var<private> s0: real;
var<private> s1: real;
var<private> s2: real;
var<private> s3: real;
var<private> s4: real;
var<private> s5: real;
var<private> s6: real;
var<private> s7: real;
var<private> s8: real;

fn clear() {
    s0 = real(0.0);
    s1 = real(0.0);
    s2 = real(0.0);
    s3 = real(0.0);
    s4 = real(0.0);
    s5 = real(0.0);
    s6 = real(0.0);
    s7 = real(0.0);
    s8 = real(0.0);
}

fn add(number: u32, factor: real) {
    let none = real(0.0);
    s0 += select(none, factor, number == 0u);
    s1 += select(none, factor, number == 1u);
    s2 += select(none, factor, number == 2u);
    s3 += select(none, factor, number == 3u);
    s4 += select(none, factor, number == 4u);
    s5 += select(none, factor, number == 5u);
    s6 += select(none, factor, number == 6u);
    s7 += select(none, factor, number == 7u);
    s8 += select(none, factor, number == 8u);
}

fn store(place: u32, scale: real) {
    let own = scale * s4;
    coarse_matrix[place] = scale * s0;
    coarse_matrix[PLACES + place] = scale * s1;
    coarse_matrix[2u * PLACES + place] = scale * s2;
    coarse_matrix[3u * PLACES + place] = scale * s3;
    coarse_matrix[4u * PLACES + place] = own;
    coarse_matrix[5u * PLACES + place] = scale * s5;
    coarse_matrix[6u * PLACES + place] = scale * s6;
    coarse_matrix[7u * PLACES + place] = scale * s7;
    coarse_matrix[8u * PLACES + place] = scale * s8;
    coarse_matrix[9u * PLACES + place] = select(real(0.0), COARSE_DAMPING / own, own != real(0.0));
}
