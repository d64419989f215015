package io.troupe.player.structures.speechrecognition;

/** Data of the Player interface speech_recognition. This client does not use it. */
public class PlayerSpeechRecognitionData {
    private int text_count;
    private String text = "";

    public synchronized int getText_count() {
        return text_count;
    }

    public synchronized void setText_count(int value) {
        text_count = value;
    }

    public synchronized String getText() {
        return text;
    }

    public synchronized void setText(String value) {
        text = value;
    }
}
