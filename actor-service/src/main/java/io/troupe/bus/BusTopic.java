package io.troupe.bus;

/**
 * A name under which values of one type are published.
 *
 * {@snippet :
 * record Temperature(double celsius) {}
 *
 * static final BusTopic<Temperature> OUTSIDE = new BusTopic<>("house/outside", Temperature.class);
 * }
 *
 * <p><b>Units and shapes.</b> The type is a record of values that can leave a process; the constructor rejects any
 * other type and names the component that is at fault. Components of a value may be null, elements of a list or a map
 * may not, and a value has at most 500 levels of records, lists and maps; a value that breaks this is rejected when it
 * is published. Two topics with the same name and different types are an error as long as a port that has used the
 * first is open.
 */
public record BusTopic<T extends Record>(String name, Class<T> type) {
    public BusTopic {
        if (name.isBlank()) {
            throw new IllegalArgumentException("the name of a topic is blank");
        }
        Portable.check("topic " + name, type);
    }
}
