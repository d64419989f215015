package io.troupe.player;

import io.troupe.player.structures.PlayerPose;
import io.troupe.player.structures.PlayerPose2d;
import io.troupe.player.structures.position2d.PlayerPosition2dCmdPos;
import io.troupe.player.structures.position2d.PlayerPosition2dCmdVel;
import io.troupe.player.structures.position2d.PlayerPosition2dData;
import io.troupe.player.structures.position2d.PlayerPosition2dGeom;
import io.troupe.player.wire.DeviceCommand;
import io.troupe.player.wire.DeviceData;
import io.troupe.player.wire.DeviceReply;
import io.troupe.player.wire.DeviceRequest;
import java.time.Duration;
import java.util.Arrays;
import java.util.Objects;
import org.jspecify.annotations.Nullable;

/**
 * A robot's drive and odometry.
 *
 * {@snippet :
 * Position2DInterface wheels = robot.requestInterfacePosition2D(0, PlayerConstants.PLAYER_OPEN_MODE);
 * wheels.setSpeed(0.3, 0); // ahead
 * while (!wheels.isDataReady())
 *     ;
 * double travelledMetres = wheels.getX();
 * }
 *
 * <p><b>Units and shapes.</b> Metres, radians, seconds; x forward, y left, turning left is positive.
 *
 * <p><b>Source.</b> Player interface position2d.
 */
public class Position2DInterface extends AbstractPositionDevice {
    private static final int MAX_LATENESS_MILLIS = 300;

    private final LatestValue<PlayerPosition2dData> data = new LatestValue<>();
    private final LatestValue<PlayerPosition2dGeom> geometry = new LatestValue<>();

    public Position2DInterface(PlayerClient client) {
        super(client);
    }

    /** The newest data, or null before the first message. */
    public @Nullable PlayerPosition2dData getData() {
        return data.get();
    }

    /** The newest reply to {@link #queryGeometry}, or null before the first. */
    public @Nullable PlayerPosition2dGeom getGeom() {
        return geometry.get();
    }

    /** True once for each new message. */
    public boolean isDataReady() {
        return pc.hasNewData(data);
    }

    /** True once for each reply. */
    public boolean isGeomReady() {
        return pc.hasReply(geometry);
    }

    @Override
    public double getX() {
        return present().getPos().getPx();
    }

    @Override
    public double getY() {
        return present().getPos().getPy();
    }

    @Override
    public double getYaw() {
        return present().getPos().getPa();
    }

    private PlayerPosition2dData present() {
        return Objects.requireNonNull(data.get(), "no data of position2d yet: wait for isDataReady()");
    }

    /**
     * Drives at a speed in metres per second and a turn rate in radians per second (left positive) until the next
     * command.
     */
    @Override
    public void setSpeed(double speed, double turnrate) {
        drive(speed, 0, turnrate, true);
    }

    /**
     * Asks the server to stop the robot when this client has not sent a speed for a given time. An addition to the
     * Player client. Without it the last speed applies until another command or the end of the connection, even if this
     * program hangs or is cut off.
     *
     * <p>The limit applies to the speeds that this client sends to this device from now on, measured on the server's
     * clock (simulated time). It does not apply to {@link #setPosition}. A newer command of another client is not
     * affected. After a speed has expired, the next one drives again. Other Player servers refuse this request and
     * decide themselves when to stop; that is logged once (INFO).
     *
     * <p>With a limit, a server of ours in another process also drops speeds that arrive more than 300 ms late: after a
     * cut of the network TCP delivers all that was sent meanwhile. Lateness is measured against the fastest message of
     * this client in the last one to two minutes, so the clocks need not agree.
     *
     * @param limit whole milliseconds, longer than the longest time between two speeds of the program; zero for no
     *     limit
     */
    public void setCommandLimit(Duration limit) {
        long millis = limit.toMillis();
        if (millis < 0 || millis > Integer.MAX_VALUE || !limit.equals(Duration.ofMillis(millis))) {
            throw new PlayerException(
                    "command limit of " + this + " is " + limit + ", expected whole milliseconds, 0 or more");
        }
        ask(new DeviceRequest.SetIntegerProperty(DeviceRequest.COMMAND_LIMIT_KEY, (int) millis));
        ask(new DeviceRequest.SetIntegerProperty(DeviceRequest.COMMAND_AGE_KEY, millis == 0 ? 0 : MAX_LATENESS_MILLIS));
    }

    @Override
    void refused(DeviceRequest request, String reason) {
        if (request instanceof DeviceRequest.SetIntegerProperty) {
            pc.commandLimitRefused(this, reason);
        } else {
            super.refused(request, reason);
        }
    }

    /**
     * Drives with a velocity in the robot's frame. Simulated robots ignore {@code state}, as in Stage: they drive with
     * 0 too; to stop, send zero speed. A differential drive ignores the sideways component.
     */
    public void setVelocity(PlayerPose2d velocity, int state) {
        drive(velocity.getPx(), velocity.getPy(), velocity.getPa(), state != 0);
    }

    /** The same as {@link #setVelocity(PlayerPose2d, int)}. */
    public void setVelocity(PlayerPosition2dCmdVel command) {
        setVelocity(command.getVel(), command.getState());
    }

    /** Drives like a car: metres per second and radians. For a differential drive the angle is the turn rate. */
    public void setCarCMD(double velocity, double angle) {
        checkFinite("drive like a car at", velocity, angle);
        send(new DeviceCommand.Car(velocity, angle));
    }

    /** Drives at a speed in metres per second towards a heading in radians, absolute in the odometry frame. */
    public void setVelHead(double velocity, double angle) {
        checkFinite("drive with the heading", velocity, angle);
        send(new DeviceCommand.VelocityHeading(velocity, angle));
    }

    /**
     * Drives to a pose in the odometry frame.
     *
     * @param velocity the speeds on the way; simulated robots use their own
     * @param state ignored by simulated robots, as in Stage: they drive with 0 too
     */
    public void setPosition(PlayerPose2d position, PlayerPose2d velocity, int state) {
        checkFinite("go to", position.getPx(), position.getPy(), position.getPa());
        checkFinite("go with", velocity.getPx(), velocity.getPy(), velocity.getPa());
        send(new DeviceCommand.GoTo(
                position.getPx(),
                position.getPy(),
                position.getPa(),
                velocity.getPx(),
                velocity.getPy(),
                velocity.getPa(),
                state != 0));
    }

    /** The same as {@link #setPosition(PlayerPose2d, PlayerPose2d, int)}. */
    public void setPosition(PlayerPosition2dCmdPos command) {
        setPosition(command.getPos(), command.getVel(), command.getState());
    }

    private void drive(double vx, double vy, double va, boolean enabled) {
        checkFinite("drive at (m/s, m/s, rad/s)", vx, vy, va);
        send(new DeviceCommand.Velocity(vx, vy, va, enabled));
    }

    private void checkFinite(String action, double... values) {
        for (double value : values) {
            if (!Double.isFinite(value)) {
                throw new PlayerException(this + " was commanded to " + action + " " + Arrays.toString(values)
                        + ", expected finite numbers");
            }
        }
    }

    /** Requests the geometry of the body; {@link #isGeomReady} is true when the reply has arrived. */
    public void queryGeometry() {
        ask(new DeviceRequest.Geometry());
    }

    /** Sets odometry to the zero pose. */
    public void resetOdometry() {
        ask(new DeviceRequest.ResetOdometry());
    }

    /** Sets odometry to a pose. */
    public void setOdometry(PlayerPose2d pose) {
        ask(new DeviceRequest.SetOdometry(pose.getPx(), pose.getPy(), pose.getPa()));
    }

    /** Switches the motors on (1) or off (0). */
    public void setMotorPower(int state) {
        ask(new DeviceRequest.Power(state != 0));
    }

    /** Selects how the robot controls its velocity, by a number that its driver defines. */
    public void setVelocityControl(int mode) {
        ask(new DeviceRequest.VelocityMode(mode));
    }

    /** Selects velocity control (0) or position control (1). */
    public void setControlMode(int mode) {
        ask(new DeviceRequest.PositionMode(mode));
    }

    public void setVelocityPIDParams(float kp, float ki, float kd) {
        ask(new DeviceRequest.SpeedPid(kp, ki, kd));
    }

    public void setPositionPIDParams(float kp, float ki, float kd) {
        ask(new DeviceRequest.PositionPid(kp, ki, kd));
    }

    /** Sets the speed (m/s) and the acceleration (m/s2) of drives to a pose. */
    public void setSpeedProfileParams(float speed, float acc) {
        ask(new DeviceRequest.SpeedProfile(speed, acc));
    }

    @Override
    void accept(DeviceReply reply) {
        if (reply instanceof DeviceReply.Position2dGeometry body) {
            var result = new PlayerPosition2dGeom();
            result.setPose(new PlayerPose(body.px(), body.py(), body.pa()));
            result.getSize().setSl(body.lengthM());
            result.getSize().setSw(body.widthM());
            geometry.put(result);
        }
    }

    @Override
    LatestValue<?> latest() {
        return data;
    }

    @Override
    void accept(DeviceData message) {
        if (message instanceof DeviceData.Position2d state) {
            var newest = new PlayerPosition2dData();
            newest.setPos(new PlayerPose(state.px(), state.py(), state.pa()));
            newest.setVel(new PlayerPose(state.vx(), state.vy(), state.va()));
            newest.setStall((byte) (state.stall() ? 1 : 0));
            data.put(newest);
        }
    }
}
