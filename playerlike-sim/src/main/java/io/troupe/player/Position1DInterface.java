package io.troupe.player;

import io.troupe.player.structures.position1d.PlayerPosition1dCmdPos;
import io.troupe.player.structures.position1d.PlayerPosition1dCmdVel;
import io.troupe.player.structures.position1d.PlayerPosition1dData;
import io.troupe.player.structures.position1d.PlayerPosition1dGeom;

/**
 * A linear actuator. This client does not support it; the class exists so that programs that mention it compile.
 *
 * <p><b>Errors.</b> Each method throws {@link PlayerException}, whose message lists the supported interfaces and the
 * devices of the server.
 *
 * <p><b>Source.</b> Player interface position1d.
 */
public class Position1DInterface extends UnsupportedDevice {
    public Position1DInterface(PlayerClient client) {
        super(client, "position1d");
    }

    public void setPosition(float pos, float vel, int state) {
        throw notSupported();
    }

    public void setPosition(PlayerPosition1dCmdPos value) {
        throw notSupported();
    }

    public void setVelocity(float vel, int state) {
        throw notSupported();
    }

    public void setVelocity(PlayerPosition1dCmdVel value) {
        throw notSupported();
    }

    public void queryGeometry() {
        throw notSupported();
    }

    public void setMotorPower(int state) {
        throw notSupported();
    }

    public void setVelocityControl(int mode) {
        throw notSupported();
    }

    public void resetOdometry() {
        throw notSupported();
    }

    public void setControlMode(int state) {
        throw notSupported();
    }

    public void setOdometry(float pos) {
        throw notSupported();
    }

    public void resetOdometry(int value) {
        throw notSupported();
    }

    public void setVelocityPIDParams(float kp, float ki, float kd) {
        throw notSupported();
    }

    public void setPositionPIDParams(float kp, float ki, float kd) {
        throw notSupported();
    }

    public void setSpeedProfileParams(float speed, float acc) {
        throw notSupported();
    }

    public PlayerPosition1dData getData() {
        throw notSupported();
    }

    public PlayerPosition1dGeom getGeom() {
        throw notSupported();
    }

    public boolean isDataReady() {
        throw notSupported();
    }

    public boolean isGeomReady() {
        throw notSupported();
    }
}
