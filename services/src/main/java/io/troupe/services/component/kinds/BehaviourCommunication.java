package io.troupe.services.component.kinds;

import io.troupe.actor.promise.Promise;
import io.troupe.services.behaviour.Behaviour;
import io.troupe.services.behaviour.Blob;
import io.troupe.services.behaviour.LaserScan;
import io.troupe.services.behaviour.ReadingTime;
import io.troupe.services.behaviour.RobotPose;
import io.troupe.services.behaviour.Senses;
import io.troupe.services.behaviour.Velocity;
import io.troupe.services.component.ComponentCommunication;
import java.util.List;
import java.util.Optional;
import java.util.function.Supplier;
import org.jspecify.annotations.Nullable;

/** The CCU of a behaviour: runs one step of the control law for each sonar reading, at most one per control cycle. */
final class BehaviourCommunication implements ComponentCommunication<BehaviourInput, Velocity> {
    private static final RobotPose UNKNOWN = new RobotPose(0, 0, 0);

    private final Supplier<? extends Behaviour> law;
    private @Nullable Behaviour behaviour;
    private @Nullable Signals<? super Velocity> signals;
    private RobotPose pose = UNKNOWN;
    private boolean stalled;
    private List<Blob> blobs = List.of();
    private LaserScan scan = LaserScan.EMPTY;
    private final ReadingTime time = new ReadingTime();
    private double lastSeconds = Double.NEGATIVE_INFINITY;

    BehaviourCommunication(Supplier<? extends Behaviour> law) {
        this.law = law;
    }

    @Override
    public Promise<@Nullable Void> invoke(Signals<? super Velocity> newSignals) {
        behaviour = law.get();
        signals = newSignals;
        return Promise.done();
    }

    @Override
    public void data(BehaviourInput input) {
        switch (input) {
            case BehaviourInput.Position position -> {
                pose = position.pose();
                stalled = position.stalled();
            }
            case BehaviourInput.Image image -> blobs = image.blobs();
            case BehaviourInput.Laser laser -> scan = laser.scan();
            case BehaviourInput.Ranges ranges -> step(ranges);
        }
    }

    private void step(BehaviourInput.Ranges ranges) {
        double nowSeconds = time.at(ranges.timeSeconds());
        if (behaviour == null || signals == null || !ReadingTime.isCycle(lastSeconds, nowSeconds)) {
            return; // ranges that arrive before the cycle is over are skipped
        }
        lastSeconds = nowSeconds;
        Optional<Velocity> wanted;
        try {
            wanted = behaviour.step(new Senses(nowSeconds, ranges.sonar(), pose, stalled, blobs, scan));
        } catch (RuntimeException | Error thrown) {
            signals.data(Velocity.STOP); // the failing behaviour cannot stop the robot any more
            throw thrown;
        }
        wanted.ifPresent(signals::data);
    }

    @Override
    public Promise<@Nullable Void> terminate() {
        if (behaviour != null && signals != null) {
            behaviour = null;
            signals.data(Velocity.STOP);
        }
        return Promise.done();
    }

    @Override
    public Promise<@Nullable Void> health() {
        return Promise.done();
    }
}
