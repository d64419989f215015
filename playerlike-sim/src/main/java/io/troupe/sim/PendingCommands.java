package io.troupe.sim;

import io.troupe.sim.PortServer.Offer;
import java.util.ArrayList;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;

/**
 * What a client has told its devices and the world does not know yet.
 *
 * <p><b>Order.</b> What it says before its answer to a tick counts at the end of that tick; what it says after it
 * counts at the end of the next, however long the other clients take. Commands are taken in the order in which they
 * came. The newest command of a kind to a device replaces an older one, and comes last, so a client that never stops
 * talking needs no more room.
 *
 * <p><b>Threads.</b> None of its own; guarded by the simulation's lock.
 */
final class PendingCommands {
    /** What a device can be told at the same time. */
    enum Kind {
        RESET,
        PLACE,
        ODOMETRY,
        POWER,
        SPEED
    }

    private record Subject(Offer device, Kind kind) {}

    private final Map<Subject, Runnable> now = new LinkedHashMap<>();
    private final Map<Subject, Runnable> later = new LinkedHashMap<>();

    /** @param late whether the client has answered the tick that is being played */
    void add(Offer device, Kind kind, Runnable command, boolean late) {
        putLast(late ? later : now, new Subject(device, kind), command);
    }

    /**
     * A map keeps the old place of a key that is put again: without the removal a second reset would come before what
     * was said after the first.
     */
    private static void putLast(Map<Subject, Runnable> commands, Subject subject, Runnable command) {
        commands.remove(subject);
        commands.put(subject, command);
    }

    /** A new tick begins. */
    void tickBegins() {
        later.forEach((subject, command) -> putLast(now, subject, command));
        later.clear();
    }

    /** All that one device was told, for a client that leaves it. */
    List<Runnable> takeAll(Offer device) {
        var taken = new ArrayList<Runnable>();
        for (var commands : List.of(now, later)) {
            for (var each = commands.entrySet().iterator(); each.hasNext(); ) {
                var command = each.next();
                if (command.getKey().device().equals(device)) {
                    taken.add(command.getValue());
                    each.remove();
                }
            }
        }
        return taken;
    }

    /** All that any device was told, for a client that goes. */
    List<Runnable> takeAll() {
        var taken = new ArrayList<>(now.values());
        taken.addAll(later.values());
        now.clear();
        later.clear();
        return taken;
    }

    /** What counts at the end of this tick. */
    List<Runnable> take() {
        var taken = new ArrayList<>(now.values());
        now.clear();
        return taken;
    }
}
