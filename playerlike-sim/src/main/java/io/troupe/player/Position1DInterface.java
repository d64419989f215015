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
public class Position1DInterface extends UnofferedDevice {
    public Position1DInterface(PlayerClient client) {
        super(client, "position1d");
    }

    public void setPosition(float pos, float vel, int state) {
        throw notOffered();
    }

    public void setPosition(PlayerPosition1dCmdPos value) {
        throw notOffered();
    }

    public void setVelocity(float vel, int state) {
        throw notOffered();
    }

    public void setVelocity(PlayerPosition1dCmdVel value) {
        throw notOffered();
    }

    public void queryGeometry() {
        throw notOffered();
    }

    public void setMotorPower(int state) {
        throw notOffered();
    }

    public void setVelocityControl(int mode) {
        throw notOffered();
    }

    public void resetOdometry() {
        throw notOffered();
    }

    public void setControlMode(int state) {
        throw notOffered();
    }

    public void setOdometry(float pos) {
        throw notOffered();
    }

    public void resetOdometry(int value) {
        throw notOffered();
    }

    public void setVelocityPIDParams(float kp, float ki, float kd) {
        throw notOffered();
    }

    public void setPositionPIDParams(float kp, float ki, float kd) {
        throw notOffered();
    }

    public void setSpeedProfileParams(float speed, float acc) {
        throw notOffered();
    }

    public PlayerPosition1dData getData() {
        throw notOffered();
    }

    public PlayerPosition1dGeom getGeom() {
        throw notOffered();
    }

    public boolean isDataReady() {
        throw notOffered();
    }

    public boolean isGeomReady() {
        throw notOffered();
    }
}
