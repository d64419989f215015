package io.troupe.services.bus;

/**
 * A name under which values of one type are published.
 *
 * <p><b>Units and shapes.</b> The type is a record of values that can leave a process; anything else is refused here, by the name of the component.
 * Two topics with one name and different types are an error of the bus.
 */
public record Topic<T extends Record>(String name, Class<T> type) {
    public Topic {
        if (name.isBlank()) {
            throw new IllegalArgumentException("the name of a topic is blank");
        }
        Portable.check("topic " + name, type);
    }
}
