package io.troupe.sim.device;

import io.troupe.sim.model.DeviceSpec;
import io.troupe.sim.model.Pose;

/**
 * A gripper: two paddles that close around a thing, two beams between them, and what it holds.
 *
 * <p>The paddles close in two seconds. Closing, they take the first grippable thing that the inner side of one touches;
 * the thing then keeps its place relative to the robot until the paddles have opened a little. They close no farther
 * than the width of the thing allows. Paddles and base collide with nothing, and neither does a thing that is held.
 *
 * <p><b>Threads.</b> The thread that advances the world. <b>Cost.</b> Four rays at each interval.
 *
 * <p><b>Source.</b> Stage's gripper model, where the thing jumps to the gripper's base when it is taken.
 */
public final class GripperDevice implements Device {
    /** Share of the way that the paddles travel in a second. */
    private static final double SHARE_PER_S = 0.5;

    private static final int NOTHING = -1;

    /** What the gripper is commanded to do. */
    public enum Order {
        OPEN,
        CLOSE
    }

    /** What holds and releases things. */
    public interface Holder {
        /** Takes a thing that moves. Returns false if another gripper has it. */
        boolean hold(int mover);

        void release(int mover);
    }

    private final DeviceSpec.Gripper spec;
    private DeviceReading.Paddles paddles;
    private double closed; // share of the way: 0 = open
    private double mostClosed = 1;
    private int held = NOTHING;
    private boolean outerBeam;
    private boolean innerBeam;

    GripperDevice(DeviceSpec.Gripper spec) {
        this.spec = spec;
        paddles = spec.closed() ? DeviceReading.Paddles.CLOSED : DeviceReading.Paddles.OPEN;
        closed = spec.closed() ? 1 : 0;
    }

    /** Begins to open or close. */
    public void order(Order order) {
        if (order == Order.OPEN && paddles != DeviceReading.Paddles.OPEN) {
            paddles = DeviceReading.Paddles.OPENING;
        } else if (order == Order.CLOSE && paddles != DeviceReading.Paddles.CLOSED) {
            paddles = DeviceReading.Paddles.CLOSING;
        }
    }

    /** Loses a thing, if it holds it, because something else has taken it away. Its paddles close farther. */
    public void lose(int mover) {
        if (held == mover) {
            held = NOTHING;
            mostClosed = 1;
            if (paddles == DeviceReading.Paddles.CLOSED && closed < 1) {
                paddles = DeviceReading.Paddles.CLOSING;
            }
        }
    }

    @Override
    public void sense(Scene scene, int robot, Scratch scratch) {
        // it changes the world, so it is updated by one thread
    }

    /** Moves the paddles for an interval, takes or releases a thing, and reads the beams. */
    public void update(Scene scene, int robot, double intervalS, Scratch scratch, Holder holder) {
        if (paddles == DeviceReading.Paddles.OPENING) {
            closed = Math.max(0, closed - SHARE_PER_S * intervalS);
            if (held != NOTHING && (closed == 0 || closed < mostClosed)) {
                holder.release(held);
                held = NOTHING;
                mostClosed = 1;
            }
            paddles = closed == 0 ? DeviceReading.Paddles.OPEN : paddles;
        } else if (paddles == DeviceReading.Paddles.CLOSING) {
            closed = Math.min(mostClosed, closed + SHARE_PER_S * intervalS);
            paddles = closed == mostClosed ? DeviceReading.Paddles.CLOSED : paddles;
        }
        if (paddles == DeviceReading.Paddles.CLOSING && held == NOTHING) {
            int touched = touched(scene, robot, scratch.ray);
            if (touched != NOTHING && holder.hold(touched)) {
                held = touched;
                mostClosed = Math.max(closed, 1 - scene.widthM(touched) / innerWidthM());
            }
        }
        readBeams(scene, robot, scratch.ray);
        if (spec.snatches()) {
            order(innerBeam || outerBeam ? Order.CLOSE : Order.OPEN);
        }
    }

    /** Distance between the open paddles. */
    private double innerWidthM() {
        return spec.widthM() * (1 - 2 * spec.paddleWidth());
    }

    /** Distance of the inner side of a paddle from the middle. */
    private double sideM() {
        return (1 - closed) * innerWidthM() / 2;
    }

    /** The beams cross the space between the paddles, at a quarter and at three quarters of their length. */
    private void readBeams(Scene scene, int robot, Ray ray) {
        double tipM = spec.lengthM() / 2;
        double paddleM = spec.paddleLength() * spec.lengthM();
        outerBeam = isBroken(scene, robot, tipM - paddleM / 4, ray);
        innerBeam = isBroken(scene, robot, tipM - paddleM * 3 / 4, ray);
    }

    private boolean isBroken(Scene scene, int robot, double aheadM, Ray ray) {
        // what is held may reach over the inner side of a paddle, and a ray does not see a thing that it starts in
        double sideM = held == NOTHING ? sideM() : innerWidthM() / 2;
        Pose from = spec.mount().compose(new Pose(aheadM, sideM, -StrictMath.PI / 2));
        return scene.gripped(robot, from.x(), from.y(), from.headingRad(), 2 * sideM, ray) != NOTHING;
    }

    /** The thing at the inner side of the left paddle or, if there is none, of the right one. */
    private int touched(Scene scene, int robot, Ray ray) {
        double paddleM = spec.paddleLength() * spec.lengthM();
        for (double side : new double[] {sideM(), -sideM()}) {
            Pose from = spec.mount().compose(new Pose(spec.lengthM() / 2 - paddleM, side, 0));
            int thing = scene.gripped(robot, from.x(), from.y(), from.headingRad(), paddleM, ray);
            if (thing != NOTHING) {
                return thing;
            }
        }
        return NOTHING;
    }

    @Override
    public DeviceReading reading(Scene scene, int robot) {
        return new DeviceReading.Grip(paddles, outerBeam, innerBeam, held != NOTHING);
    }
}
