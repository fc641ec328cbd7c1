
fn main() {
    print();
}
