package io.troupe.services.component;

import io.troupe.bus.BusTopic;

/**
 * A value in the application's format: a record published on a topic. The component behind an interface may use another
 * format; {@link Conversion} translates.
 */
public record ApplicationData<T extends Record>(BusTopic<T> topic, T value) {
    @Override
    public String toString() {
        return topic.name() + " " + value;
    }
}
