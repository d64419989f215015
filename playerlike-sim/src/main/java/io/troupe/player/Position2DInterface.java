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
import java.util.Objects;
import org.jspecify.annotations.Nullable;

/**
 * A robot's wheels and odometry.
 *
 * <p><b>Units and shapes.</b> Metres, radians, seconds; x forward, y left, turning left is positive.
 * <p><b>Source.</b> Player interface position2d.
 */
public class Position2DInterface extends AbstractPositionDevice {
    private final Latest<PlayerPosition2dData> data = new Latest<>();
    private final Latest<PlayerPosition2dGeom> geometry = new Latest<>();

    public Position2DInterface(PlayerClient client) {
        super(client);
    }

    /** The newest data, or null before there are any. */
    public @Nullable PlayerPosition2dData getData() {
        return data.get();
    }

    /** The answer to {@link #queryGeometry}, or null before. */
    public @Nullable PlayerPosition2dGeom getGeom() {
        return geometry.get();
    }

    /** True once for each new message. */
    public boolean isDataReady() {
        return pc.findsNews(data);
    }

    /** True once for each answer. */
    public boolean isGeomReady() {
        return geometry.takeNew();
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

    /** Drives at a speed in metres per second and a turn rate in radians per second, left positive, until told otherwise. */
    @Override
    public void setSpeed(double speed, double turnrate) {
        drive(speed, 0, turnrate, true);
    }

    /** Drives with a velocity in the robot's frame; state 0 stops the motors. A differential drive ignores the part to the side, as Stage does. */
    public void setVelocity(PlayerPose2d velocity, int state) {
        drive(velocity.getPx(), velocity.getPy(), velocity.getPa(), state != 0);
    }

    /** The same as {@link #setVelocity(PlayerPose2d, int)}. */
    public void setVelocity(PlayerPosition2dCmdVel command) {
        setVelocity(command.getVel(), command.getState());
    }

    /** Drives like a car; for a differential drive the angle is the turn rate. */
    public void setCarCMD(double velocity, double angle) {
        drive(velocity, 0, angle, true);
    }

    private void drive(double vx, double vy, double va, boolean enabled) {
        if (!Double.isFinite(vx) || !Double.isFinite(vy) || !Double.isFinite(va)) {
            throw new PlayerException(this + " was told to drive at (" + vx + ", " + vy + ") m/s and " + va
                    + " rad/s, expected finite numbers");
        }
        send(new DeviceCommand.Velocity(vx, vy, va, enabled));
    }

    /** Not offered yet: driving to a pose. */
    public void setPosition(PlayerPose2d position, PlayerPose2d velocity, int state) {
        throw notOffered("setPosition");
    }

    /** Not offered yet: driving to a pose. */
    public void setPosition(PlayerPosition2dCmdPos command) {
        throw notOffered("setPosition");
    }

    /** Not offered yet: driving with a heading. */
    public void setVelHead(double velocity, double angle) {
        throw notOffered("setVelHead");
    }

    /** Asks for the body's geometry. */
    public void queryGeometry() {
        if (ask(new DeviceRequest.Geometry()) instanceof DeviceReply.Position2dGeometry reply) {
            var answer = new PlayerPosition2dGeom();
            answer.setPose(new PlayerPose(reply.px(), reply.py(), reply.pa()));
            answer.getSize().setSl(reply.lengthM());
            answer.getSize().setSw(reply.widthM());
            geometry.put(answer);
        }
    }

    /** Makes odometry report the zero pose here. */
    public void resetOdometry() {
        ask(new DeviceRequest.ResetOdometry());
    }

    /** Makes odometry report this pose here. */
    public void setOdometry(PlayerPose2d pose) {
        ask(new DeviceRequest.SetOdometry(pose.getPx(), pose.getPy(), pose.getPa()));
    }

    /** Switches the motors on (1) or off (0); those of a simulated robot are always on and refuse the latter. */
    public void setMotorPower(int state) {
        ask(new DeviceRequest.Power(state != 0));
    }

    /** Not offered yet. */
    public void setVelocityControl(int mode) {
        throw notOffered("setVelocityControl");
    }

    /** Chooses between velocity (0), which is how robots are driven here, and position (1), which is not offered yet. */
    public void setControlMode(int mode) {
        if (mode != 0) {
            throw notOffered("setControlMode(" + mode + ")");
        }
    }

    /** Not offered yet. */
    public void setVelocityPIDParams(float kp, float ki, float kd) {
        throw notOffered("setVelocityPIDParams");
    }

    /** Not offered yet. */
    public void setPositionPIDParams(float kp, float ki, float kd) {
        throw notOffered("setPositionPIDParams");
    }

    /** Not offered yet. */
    public void setSpeedProfileParams(float speed, float acc) {
        throw notOffered("setSpeedProfileParams");
    }

    @Override
    Latest<?> latest() {
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
