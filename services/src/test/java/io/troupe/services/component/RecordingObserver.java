package io.troupe.services.component;

import io.troupe.bus.Address;
import java.util.ArrayList;
import java.util.List;

/** A component observer that records its notifications. */
public class RecordingObserver implements ComponentObserver {
    private final List<String> notes = new ArrayList<>(); // guarded by this: processes have threads

    @Override
    public synchronized void changed(Address component, ComponentState state) {
        notes.add(component.name() + " " + state);
    }

    @Override
    public synchronized void dropped(Address component, ApplicationData<?> lost, long total) {
        notes.add(component.name() + " dropped " + lost.value() + ", " + total + " so far");
    }

    @Override
    public synchronized void problem(Address component, String what, Throwable why) {
        notes.add(component.name() + " " + what + ": " + why.getMessage());
    }

    @Override
    public synchronized void info(Address component, String what) {
        notes.add(component.name() + " " + what);
    }

    /** Returns the notes since the last call. */
    public synchronized List<String> take() {
        var taken = List.copyOf(notes);
        notes.clear();
        return taken;
    }
}
