package io.troupe.sim;

import io.troupe.sim.PortServer.PortDevice;
import java.util.ArrayList;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;

/**
 * Commands that a client has sent to its devices and that have not yet reached the world.
 *
 * <p><b>Order.</b> A command sent before the client's answer to a tick applies at the end of that tick; one sent after
 * the answer applies at the end of the next tick, however long the other clients take. Commands apply in the order of
 * arrival. The newest command of a kind to a device replaces the older one and moves to the end, so the memory is
 * bounded for any number of commands.
 *
 * <p><b>Threads.</b> Guarded by the simulation's lock.
 */
final class ClientCommands {
    /** Kinds of commands that can be pending for a device at the same time. */
    enum Kind {
        RESET,
        PLACE,
        ODOMETRY,
        POWER,
        INTENSITIES,
        GRIPPER,
        SPEED
    }

    private record Subject(PortDevice device, Kind kind) {}

    private final Map<Subject, Runnable> now = new LinkedHashMap<>();
    private final Map<Subject, Runnable> later = new LinkedHashMap<>();

    /** @param late true if the client has already answered the current tick */
    void add(PortDevice device, Kind kind, Runnable command, boolean late) {
        putLast(late ? later : now, new Subject(device, kind), command);
    }

    /**
     * Puts a command at the end. A map keeps the position of an existing key: without the removal, a second reset would
     * run before the commands sent after the first.
     */
    private static void putLast(Map<Subject, Runnable> commands, Subject subject, Runnable command) {
        commands.remove(subject);
        commands.put(subject, command);
    }

    /** Makes the late commands current, as a new tick begins. */
    void tickBegins() {
        later.forEach((subject, command) -> putLast(now, subject, command));
        later.clear();
    }

    /** Takes all commands for one device, when a client unsubscribes from it. */
    List<Runnable> takeAll(PortDevice device) {
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

    /** Takes all commands for all devices, when a client disconnects. */
    List<Runnable> takeAll() {
        var taken = new ArrayList<>(now.values());
        taken.addAll(later.values());
        now.clear();
        later.clear();
        return taken;
    }

    /** Takes the commands that apply at the end of this tick. */
    List<Runnable> take() {
        var taken = new ArrayList<>(now.values());
        now.clear();
        return taken;
    }
}
