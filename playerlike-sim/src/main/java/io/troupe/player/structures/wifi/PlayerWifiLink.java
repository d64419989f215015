package io.troupe.player.structures.wifi;

/** Part of a message of the Player interface wifi. This client does not use it. */
public class PlayerWifiLink {
    private int mac_count;
    private byte[] mac = new byte[0];
    private int ip_count;
    private byte[] ip = new byte[0];
    private int essid_count;
    private byte[] essid = new byte[0];
    private int mode;
    private int freq;
    private int encrypt;
    private int qual;
    private int level;
    private int noise;

    public synchronized int getMac_count() {
        return mac_count;
    }

    public synchronized void setMac_count(int value) {
        mac_count = value;
    }

    public synchronized byte[] getMac() {
        return mac;
    }

    public synchronized void setMac(byte[] value) {
        mac = value;
    }

    public synchronized int getIp_count() {
        return ip_count;
    }

    public synchronized void setIp_count(int value) {
        ip_count = value;
    }

    public synchronized byte[] getIp() {
        return ip;
    }

    public synchronized void setIp(byte[] value) {
        ip = value;
    }

    public synchronized int getEssid_count() {
        return essid_count;
    }

    public synchronized void setEssid_count(int value) {
        essid_count = value;
    }

    public synchronized byte[] getEssid() {
        return essid;
    }

    public synchronized void setEssid(byte[] value) {
        essid = value;
    }

    public synchronized int getMode() {
        return mode;
    }

    public synchronized void setMode(int value) {
        mode = value;
    }

    public synchronized int getFreq() {
        return freq;
    }

    public synchronized void setFreq(int value) {
        freq = value;
    }

    public synchronized int getEncrypt() {
        return encrypt;
    }

    public synchronized void setEncrypt(int value) {
        encrypt = value;
    }

    public synchronized int getQual() {
        return qual;
    }

    public synchronized void setQual(int value) {
        qual = value;
    }

    public synchronized int getLevel() {
        return level;
    }

    public synchronized void setLevel(int value) {
        level = value;
    }

    public synchronized int getNoise() {
        return noise;
    }

    public synchronized void setNoise(int value) {
        noise = value;
    }
}
