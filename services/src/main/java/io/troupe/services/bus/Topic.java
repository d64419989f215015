package io.troupe.services.bus;

/**
 * A name under which values of one type are published.
 *
 * <p><b>Units and shapes.</b> The type is a record of values that can leave a process; anything else is refused here,
 * by the name of the component. Of a value, components may be null, but nothing in a list or a map, and it has at most
 * 500 levels of records, lists and maps; another one is refused when it is published. Two topics with one name and
 * different types are an error of the bus, as long as a port that has used the first is open.
 */
public record Topic<T extends Record>(String name, Class<T> type) {
    public Topic {
        if (name.isBlank()) {
            throw new IllegalArgumentException("the name of a topic is blank");
        }
        Portable.check("topic " + name, type);
    }
}
