package io.troupe.view.live;

import io.troupe.actor.Clock;
import io.troupe.sim.model.WorldSpec;
import io.troupe.view.live.ViewCommand.Intervention;
import io.troupe.view.tools.RecordedInterventions;
import java.io.IOException;
import java.nio.file.Path;
import java.util.ArrayDeque;
import java.util.ArrayList;
import java.util.Deque;
import java.util.List;
import java.util.Map;
import java.util.function.BooleanSupplier;

/**
 * Commands of viewers for a run whose loop is the caller's: before each interval the loop calls {@link #await}, which
 * waits while time is paused or too fast, and returns what is to be changed.
 *
 * <p><b>Threads.</b> One thread calls {@code await}, any thread the rest.
 *
 * <p><b>Order.</b> Commands take effect in the order in which they came. Of several that set the same, only the newest
 * does.
 */
public final class RunControl implements ViewControl {
    private static final long POLL_MILLIS = 50;
    /** A run that is later than this does not catch up. */
    private static final long LATE_NANOS = 250_000_000;

    private static final List<String> TIME = List.of("pause", "resume", "step", "speed");
    static final List<String> ALL =
            List.of("pause", "resume", "step", "speed", "reset", "place", "drive", "release", "box", "unbox");

    /** An intervention of a recorded run. */
    private record Scheduled(long timeMicros, Intervention intervention) {}

    private final Clock wall;
    private final boolean canIntervene;
    private final List<Intervention> pending = new ArrayList<>();
    private final Deque<Scheduled> scheduled = new ArrayDeque<>();
    private final HandDriving driving;
    private boolean paused;
    private int stepsWanted;
    private double speed;
    private long originNanos;
    private long originMicros = -1; // -1: from the next interval on

    /**
     * Creates the control of one run.
     *
     * @param speed simulated seconds per second at first; 0 = as fast as possible
     * @param canIntervene whether viewers may change what happens in the world
     */
    public RunControl(double speed, boolean canIntervene) {
        this(Clock.system(), speed, canIntervene);
    }

    RunControl(Clock wall, double speed, boolean canIntervene) {
        this.wall = wall;
        this.driving = new HandDriving(wall);
        this.speed = speed;
        this.canIntervene = canIntervene;
    }

    @Override
    public List<String> offers() {
        return canIntervene ? ALL : TIME;
    }

    @Override
    public synchronized void submit(ViewCommand command) {
        switch (command) {
            case ViewCommand.Pause() -> paused = true;
            case ViewCommand.Resume() -> {
                paused = false;
                stepsWanted = 0;
                originMicros = -1;
            }
            case ViewCommand.Step() -> {
                paused = true;
                stepsWanted++;
            }
            case ViewCommand.Speed(double factor) -> {
                speed = factor;
                originMicros = -1;
            }
            case Intervention intervention -> add(intervention);
        }
        notifyAll();
    }

    private void add(Intervention intervention) {
        if (!canIntervene) {
            throw new IllegalArgumentException("this run can be paused, but nothing in it can be changed");
        }
        driving.note(intervention);
        pending.removeIf(intervention::replaces);
        pending.add(intervention);
    }

    @Override
    public synchronized boolean isPaused() {
        return paused;
    }

    @Override
    public synchronized double speed() {
        return speed;
    }

    /**
     * Repeats the interventions of a recorded run at the times at which they took effect, so that the same run follows.
     *
     * @param log a {@code run.jsonl}
     * @param settings what the header of the log must have, for example its seed
     * @throws io.troupe.view.tools.RunFileException if the log is no run, or one in another world or with other
     *     settings
     * @throws IllegalArgumentException if a line of the log is no intervention in such a world
     */
    public synchronized void repeat(Path log, WorldSpec world, Map<String, String> settings) throws IOException {
        for (var each : RecordedInterventions.read(log, world, settings)) {
            Intervention intervention = parse(each.words(), world.robots().size(), log + ", line " + each.line());
            scheduled.addLast(new Scheduled(each.timeMicros(), intervention));
        }
    }

    private static Intervention parse(String words, int robots, String where) {
        try {
            if (ViewCommand.parse(words, robots) instanceof Intervention intervention) {
                return intervention;
            }
        } catch (IllegalArgumentException e) {
            throw new IllegalArgumentException(where + ": " + e.getMessage(), e);
        }
        throw new IllegalArgumentException(where + ": '" + words + "' changes nothing in the world");
    }

    /**
     * Waits until the interval that begins at this time may pass.
     *
     * @param stop ends the wait
     * @return what is to be changed before the interval
     */
    public synchronized List<Intervention> await(long timeMicros, BooleanSupplier stop) throws InterruptedException {
        while (!stop.getAsBoolean() && !mayPass(timeMicros)) {
            wait(waitMillis(timeMicros));
        }
        driving.takeSilent().forEach(robot -> pending.add(new ViewCommand.Release(robot)));
        List<Intervention> taken = new ArrayList<>();
        while (!scheduled.isEmpty() && scheduled.getFirst().timeMicros <= timeMicros) {
            taken.add(scheduled.removeFirst().intervention);
        }
        taken.addAll(pending);
        pending.clear();
        return taken;
    }

    private boolean mayPass(long timeMicros) {
        if (!paused) {
            return dueNanos(timeMicros) <= wall.nanos();
        }
        originMicros = -1;
        if (stepsWanted == 0) {
            return false;
        }
        stepsWanted--;
        return true;
    }

    private long waitMillis(long timeMicros) {
        return paused ? POLL_MILLIS : Math.clamp((dueNanos(timeMicros) - wall.nanos()) / 1_000_000, 1, POLL_MILLIS);
    }

    private long dueNanos(long timeMicros) {
        long now = wall.nanos();
        if (speed == 0) {
            return now;
        }
        long due = originNanos + (long) ((timeMicros - originMicros) * 1000 / speed);
        if (originMicros < 0 || now - due > LATE_NANOS) {
            originNanos = now;
            originMicros = timeMicros;
            return now;
        }
        return due;
    }
}
