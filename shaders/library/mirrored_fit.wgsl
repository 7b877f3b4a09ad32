// Least-squares fit of the projected velocity at one point, walls as mirrors; (2.5) of the paper. Of what mirrors turn round,
// `falling`, the part that gravity gave in this step, is none: the pressure of an image answers it.

#import mirror
#import weight
#import normal_equations

alias value = vector;

var<private> right: Coefficients;
var<private> own: vector;
var<private> falling: vector;

fn visit(near: Neighbour) {
    let turned = select(vector(), falling + falling, near.flip < vector());
    let there = projected[near.j] * near.flip + turned;
    right = add_term(right, monomials(near.offset), weight(near.square) * (there - own));
}

fn fit_of(i: u32, fallen: vector) -> Coefficients {
    right = Coefficients();
    own = projected[i];
    falling = fallen;
    look_around(i);
    return solve(i, right);
}
