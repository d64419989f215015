package io.troupe.player.structures.wifi;

/** Data of the Player interface wifi. This client does not use it. */
public class PlayerWifiData {
    private int links_count;
    private PlayerWifiLink[] links = new PlayerWifiLink[0];
    private int throughput;
    private int bitrate;
    private int mode;
    private int qual_type;
    private int maxqual;
    private int maxlevel;
    private int maxnoise;
    private char[] ap = new char[0];

    public synchronized int getLinks_count() {
        return links_count;
    }

    public synchronized void setLinks_count(int value) {
        links_count = value;
    }

    public synchronized PlayerWifiLink[] getLinks() {
        return links;
    }

    public synchronized void setLinks(PlayerWifiLink[] value) {
        links = value;
    }

    public synchronized int getThroughput() {
        return throughput;
    }

    public synchronized void setThroughput(int value) {
        throughput = value;
    }

    public synchronized int getBitrate() {
        return bitrate;
    }

    public synchronized void setBitrate(int value) {
        bitrate = value;
    }

    public synchronized int getMode() {
        return mode;
    }

    public synchronized void setMode(int value) {
        mode = value;
    }

    public synchronized int getQual_type() {
        return qual_type;
    }

    public synchronized void setQual_type(int value) {
        qual_type = value;
    }

    public synchronized int getMaxqual() {
        return maxqual;
    }

    public synchronized void setMaxqual(int value) {
        maxqual = value;
    }

    public synchronized int getMaxlevel() {
        return maxlevel;
    }

    public synchronized void setMaxlevel(int value) {
        maxlevel = value;
    }

    public synchronized int getMaxnoise() {
        return maxnoise;
    }

    public synchronized void setMaxnoise(int value) {
        maxnoise = value;
    }

    public synchronized char[] getAp() {
        return ap;
    }

    public synchronized void setAp(char[] value) {
        ap = value;
    }
}
