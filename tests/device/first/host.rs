fn main() {
    print();
}
