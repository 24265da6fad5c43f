// The virial of two parts of the neighbours, for a law that merges its sums.
fn merge(total: ptr<function, Sum>, part: Sum) {
    (*total).normal += part.normal;
    (*total).shear += part.shear;
    (*total).force += part.force;
    (*total).size += part.size;
    var whole = (*total).whole;
    pair_merge(&whole, part.whole);
    (*total).whole = whole;
}
