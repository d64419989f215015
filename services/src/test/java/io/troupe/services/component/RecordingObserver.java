package io.troupe.services.component;

import io.troupe.bus.Address;
import java.util.List;
import java.util.Objects;
import java.util.Queue;
import java.util.concurrent.ConcurrentLinkedQueue;
import java.util.stream.Stream;

/** A component observer that records its notifications. */
public class RecordingObserver implements ComponentObserver {
    private final Queue<String> notes = new ConcurrentLinkedQueue<>(); // processes have threads

    @Override
    public void dropped(Address component, ApplicationData<?> lost, long total) {
        info(component, "dropped " + lost.value() + ", " + total + " so far");
    }

    @Override
    public void problem(Address component, String what, Throwable why) {
        info(component, what + ": " + why.getMessage());
    }

    @Override
    public void info(Address component, String what) {
        notes.add(component.name() + " " + what);
    }

    /** Returns the notes since the last call. */
    public List<String> take() {
        return Stream.generate(notes::poll).takeWhile(Objects::nonNull).toList();
    }
}
