package io.troupe.view.live;

import io.troupe.actor.Clock;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.TreeMap;

/** The robots that viewers drive; one whose driver is silent for a second is to be released. One thread at a time. */
final class HandDriving {
    private static final long SILENT_NANOS = Duration.ofSeconds(1).toNanos();

    private final Clock wall;
    private final Map<Integer, Long> drivenNanos = new TreeMap<>(); // by robot: time of the newest command

    HandDriving(Clock wall) {
        this.wall = wall;
    }

    void note(ViewCommand.Intervention intervention) {
        if (intervention instanceof ViewCommand.Drive drive) {
            drivenNanos.put(drive.robot(), wall.nanos());
        } else if (intervention instanceof ViewCommand.Release release) {
            drivenNanos.remove(release.robot());
        }
    }

    /** The robots that are to be released now; they are forgotten. */
    List<Integer> takeSilent() {
        if (drivenNanos.isEmpty()) {
            return List.of();
        }
        long now = wall.nanos();
        List<Integer> silent = new ArrayList<>();
        drivenNanos.forEach((robot, nanos) -> {
            if (now - nanos > SILENT_NANOS) {
                silent.add(robot);
            }
        });
        drivenNanos.keySet().removeAll(silent);
        return silent;
    }
}
