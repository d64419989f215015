package io.troupe.player.structures.gps;

/** Data of the Player interface gps. This client does not use it. */
public class PlayerGpsData {
    private int time_sec;
    private int time_usec;
    private int latitude;
    private int longitude;
    private int altitude;
    private double utm_e;
    private double utm_n;
    private int quality;
    private int num_sats;
    private int hdop;
    private int vdop;
    private double err_horz;
    private double err_vert;

    public synchronized int getTime_sec() {
        return time_sec;
    }

    public synchronized void setTime_sec(int value) {
        time_sec = value;
    }

    public synchronized int getTime_usec() {
        return time_usec;
    }

    public synchronized void setTime_usec(int value) {
        time_usec = value;
    }

    public synchronized int getLatitude() {
        return latitude;
    }

    public synchronized void setLatitude(int value) {
        latitude = value;
    }

    public synchronized int getLongitude() {
        return longitude;
    }

    public synchronized void setLongitude(int value) {
        longitude = value;
    }

    public synchronized int getAltitude() {
        return altitude;
    }

    public synchronized void setAltitude(int value) {
        altitude = value;
    }

    public synchronized double getUtm_e() {
        return utm_e;
    }

    public synchronized void setUtm_e(double value) {
        utm_e = value;
    }

    public synchronized double getUtm_n() {
        return utm_n;
    }

    public synchronized void setUtm_n(double value) {
        utm_n = value;
    }

    public synchronized int getQuality() {
        return quality;
    }

    public synchronized void setQuality(int value) {
        quality = value;
    }

    public synchronized int getNum_sats() {
        return num_sats;
    }

    public synchronized void setNum_sats(int value) {
        num_sats = value;
    }

    public synchronized int getHdop() {
        return hdop;
    }

    public synchronized void setHdop(int value) {
        hdop = value;
    }

    public synchronized int getVdop() {
        return vdop;
    }

    public synchronized void setVdop(int value) {
        vdop = value;
    }

    public synchronized double getErr_horz() {
        return err_horz;
    }

    public synchronized void setErr_horz(double value) {
        err_horz = value;
    }

    public synchronized double getErr_vert() {
        return err_vert;
    }

    public synchronized void setErr_vert(double value) {
        err_vert = value;
    }
}
