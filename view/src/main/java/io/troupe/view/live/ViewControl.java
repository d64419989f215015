package io.troupe.view.live;

import java.util.List;

/** Carries out the commands of viewers. Any thread may call it. */
public interface ViewControl {
    /** The first words of the commands that it carries out. */
    List<String> offers();

    /**
     * Carries out a command, now or before the next interval.
     *
     * @throws IllegalArgumentException with a reason for the viewer
     */
    void submit(ViewCommand command);

    boolean isPaused();

    /** Simulated seconds per second that are wanted; 0 = as fast as possible. */
    double speed();

    /** What must come before time passes, for example "clients"; empty if nothing is missing. */
    default String waitsFor() {
        return "";
    }

    /** For a world that viewers can only look at. */
    ViewControl NONE = new ViewControl() {
        @Override
        public List<String> offers() {
            return List.of();
        }

        @Override
        public void submit(ViewCommand command) {
            throw new IllegalArgumentException("this world can only be watched");
        }

        @Override
        public boolean isPaused() {
            return false;
        }

        @Override
        public double speed() {
            return 0;
        }
    };
}
