package io.troupe.player.structures;

/**
 * Numbers of the Player protocol that programs use by name.
 *
 * <p><b>Source.</b> Player 3 protocol: message types, access modes, interface codes.
 */
public interface PlayerConstants {
    /** Access mode: subscribe. */
    int PLAYER_OPEN_MODE = 1;
    /** Access mode: unsubscribe. */
    int PLAYER_CLOSE_MODE = 2;
    /** Access mode in a reply: refused. */
    short PLAYER_ERROR_MODE = 3;

    /** Data are sent as soon as they are published. */
    int PLAYER_DATAMODE_PUSH = 1;
    /** Data are sent when they are asked for. */
    int PLAYER_DATAMODE_PULL = 2;

    short PLAYER_MSGTYPE_DATA = 1;
    short PLAYER_MSGTYPE_CMD = 2;
    short PLAYER_MSGTYPE_REQ = 3;
    short PLAYER_MSGTYPE_RESP_ACK = 4;
    short PLAYER_MSGTYPE_SYNCH = 5;
    short PLAYER_MSGTYPE_RESP_NACK = 6;

    short PLAYER_PLAYER_CODE = 1;
    short PLAYER_POSITION2D_CODE = 4;
    short PLAYER_SONAR_CODE = 5;
    short PLAYER_BLOBFINDER_CODE = 7;
    short PLAYER_SIMULATION_CODE = 31;

    int PLAYER_SONAR_MAX_SAMPLES = 64;
}
