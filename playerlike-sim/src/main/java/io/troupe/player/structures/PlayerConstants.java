package io.troupe.player.structures;

/**
 * Constants of the Player protocol.
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
    /** Data are sent on request. */
    int PLAYER_DATAMODE_PULL = 2;

    short PLAYER_MSGTYPE_DATA = 1;
    short PLAYER_MSGTYPE_CMD = 2;
    short PLAYER_MSGTYPE_REQ = 3;
    short PLAYER_MSGTYPE_RESP_ACK = 4;
    short PLAYER_MSGTYPE_SYNCH = 5;
    short PLAYER_MSGTYPE_RESP_NACK = 6;

    short PLAYER_PLAYER_CODE = 1;
    short PLAYER_POWER_CODE = 2;
    short PLAYER_GRIPPER_CODE = 3;
    short PLAYER_POSITION2D_CODE = 4;
    short PLAYER_SONAR_CODE = 5;
    short PLAYER_LASER_CODE = 6;
    short PLAYER_BLOBFINDER_CODE = 7;
    short PLAYER_PTZ_CODE = 8;
    short PLAYER_AUDIO_CODE = 9;
    short PLAYER_FIDUCIAL_CODE = 10;
    short PLAYER_SPEECH_CODE = 12;
    short PLAYER_GPS_CODE = 13;
    short PLAYER_BUMPER_CODE = 14;
    short PLAYER_TRUTH_CODE = 15;
    short PLAYER_DIO_CODE = 20;
    short PLAYER_AIO_CODE = 21;
    short PLAYER_IR_CODE = 22;
    short PLAYER_WIFI_CODE = 23;
    short PLAYER_WAVEFORM_CODE = 24;
    short PLAYER_LOCALIZE_CODE = 25;
    short PLAYER_MCOM_CODE = 26;
    short PLAYER_SOUND_CODE = 27;
    short PLAYER_AUDIODSP_CODE = 28;
    short PLAYER_AUDIOMIXER_CODE = 29;
    short PLAYER_POSITION3D_CODE = 30;
    short PLAYER_SIMULATION_CODE = 31;
    short PLAYER_SERVICE_ADV_CODE = 32;
    short PLAYER_BLINKENLIGHT_CODE = 33;
    short PLAYER_NOMAD_CODE = 34;
    short PLAYER_CAMERA_CODE = 40;
    short PLAYER_MAP_CODE = 42;
    short PLAYER_PLANNER_CODE = 44;
    short PLAYER_LOG_CODE = 45;
    short PLAYER_ENERGY_CODE = 46;
    short PLAYER_JOYSTICK_CODE = 49;
    short PLAYER_SPEECH_RECOGNITION_CODE = 50;
    short PLAYER_OPAQUE_CODE = 51;
    short PLAYER_POSITION1D_CODE = 52;
    short PLAYER_ACTARRAY_CODE = 53;
    short PLAYER_LIMB_CODE = 54;
    short PLAYER_GRAPHICS2D_CODE = 55;
    short PLAYER_RFID_CODE = 56;
    short PLAYER_WSN_CODE = 57;
    short PLAYER_GRAPHICS3D_CODE = 58;
    short PLAYER_HEALTH_CODE = 59;
    short PLAYER_IMU_CODE = 60;
    short PLAYER_POINTCLOUD3D_CODE = 61;
    short PLAYER_RANGER_CODE = 62;
    short PLAYER_VECTORMAP_CODE = 63;
    short PLAYER_BLACKBOARD_CODE = 64;
    short PLAYER_STEREO_CODE = 65;
    short PLAYER_COOPOBJECT_CODE = 66;
    short PLAYER_NULL_CODE = 256;

    int PLAYER_SONAR_MAX_SAMPLES = 64;

    int PLAYER_ACTARRAY_ACTSTATE_IDLE = 1;
    int PLAYER_ACTARRAY_ACTSTATE_MOVING = 2;
    int PLAYER_ACTARRAY_ACTSTATE_BRAKED = 5;
    int PLAYER_ACTARRAY_ACTSTATE_STALLED = 8;
    int PLAYER_ACTARRAY_TYPE_LINEAR = 1;
    int PLAYER_ACTARRAY_TYPE_ROTARY = 2;
    int PLAYER_BUMPER_MAX_SAMPLES = 32;
    int PLAYER_CAMERA_COMPRESS_RAW = 0;
    int PLAYER_CAMERA_COMPRESS_JPEG = 1;
    int PLAYER_CAMERA_FORMAT_MONO8 = 1;
    int PLAYER_CAMERA_FORMAT_MONO16 = 2;
    int PLAYER_CAMERA_FORMAT_RGB565 = 4;
    int PLAYER_CAMERA_FORMAT_RGB888 = 5;
    int PLAYER_FIDUCIAL_MAX_SAMPLES = 32;
    int PLAYER_GRIPPER_CMD_OPEN = 1;
    int PLAYER_GRIPPER_CMD_CLOSE = 2;
    int PLAYER_GRIPPER_CMD_STOP = 3;
    int PLAYER_GRIPPER_CMD_STORE = 4;
    int PLAYER_GRIPPER_CMD_RETRIEVE = 5;
    int PLAYER_GRIPPER_STATE_OPEN = 1;
    int PLAYER_GRIPPER_STATE_CLOSED = 2;
    int PLAYER_GRIPPER_STATE_MOVING = 3;
    int PLAYER_GRIPPER_STATE_ERROR = 4;
    int PLAYER_LASER_MAX_SAMPLES = 1024;
    int PLAYER_LOG_TYPE_READ = 1;
    int PLAYER_LOG_TYPE_WRITE = 2;
    int PLAYER_POWER_MASK_VOLTS = 1;
    int PLAYER_POWER_MASK_WATTS = 2;
    int PLAYER_POWER_MASK_JOULES = 4;
    int PLAYER_POWER_MASK_PERCENT = 8;
    int PLAYER_POWER_MASK_CHARGING = 16;
    int PLAYER_PTZ_VELOCITY_CONTROL = 0;
    int PLAYER_PTZ_POSITION_CONTROL = 1;
}
