package io.troupe.services.component;

import io.troupe.services.bus.BusTopic;

/**
 * A value as the application knows it: a record under a topic. The component behind an interface may know it in quite
 * another form.
 */
public record ApplicationData<T extends Record>(BusTopic<T> topic, T value) {
    @Override
    public String toString() {
        return topic.name() + " " + value;
    }
}
