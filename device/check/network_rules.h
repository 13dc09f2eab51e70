#pragma once

#include "device/check/device_rule.h"

// What a device across the network has to do, according to the page of its datagrams
// (device/network/README.md). Each wrong device of the references breaks the rule of its name.

namespace jnd::device {

inline constexpr DeviceRule kOtherVersion = {
    "other_version", "A hello of another version is refused for reason 3.",
    "Answer a hello whose version is not yours with a refusal, so that people read why nothing "
    "works."};
inline constexpr DeviceRule kBadKey = {
    "bad_key",
    "A hello that is sealed by another key is refused for reason 4, and opens nothing.",
    "Compare the seal of every hello before anything else is done with it."};
inline constexpr DeviceRule kUnknownStream = {
    "unknown_stream",
    "A command on a stream that the device does not know is refused for "
    "reason 2.",
    "Answer it so, or a program does not notice that the device was started anew."};
inline constexpr DeviceRule kDatagrams = {
    "datagrams", "Every datagram is whole, finite and of the sizes of the page.",
    "Compare the bytes with the tables of device/network/README.md, the checksum first."};
inline constexpr DeviceRule kArmsWithForce = {
    "arms_with_force", "An arming is granted to a command without any force alone.",
    "Grant a new arm_number only where all fifteen forces are zero."};
inline constexpr DeviceRule kArming = {
    "arming", "It arms on a new number, without force, once the connection is good.",
    "Tell armed and armed_number in the state; 100 good datagrams and a round trip are "
    "enough. The number 0 asks for no arming."};
inline constexpr DeviceRule kHalfRate = {
    "half_rate", "States come at the rate of the welcome.",
    "Send one state a tick, and tell the rate of the loop that really runs."};
inline constexpr DeviceRule kJitter = {
    "jitter", "Of a hundred states 99 come within the time that one may stand in.",
    "Give the device's loop real-time priority, and look what holds it up."};
inline constexpr DeviceRule kSequenceStep = {
    "sequence_step", "Numbers of datagrams go on by one, whatever their kind.",
    "Count each datagram of the stream once."};
inline constexpr DeviceRule kSequenceWrap = {
    "sequence_wrap", "Numbers of datagrams wrap at 2^32.",
    "Count in an unsigned integer of 32 bits, and let it wrap."};
inline constexpr DeviceRule kUnits = {
    "units_mm", "Positions are in m and velocities in m/s, of a hand.",
    "Convert what the robot measures before it goes into the state."};
inline constexpr DeviceRule kStale = {
    "stale", "Every state holds a new measurement, with a device time that rises.",
    "Measure in every tick, and leave is_measured 0 where that failed."};
inline constexpr DeviceRule kTime = {
    "time", "The device time is in ns and goes on as time does.",
    "Tell the device's own clock in ns, of the moment when it measured."};
inline constexpr DeviceRule kVelocity = {
    "velocity", "Velocities are how fast the positions change.",
    "Tell the velocity of the same point and axis, in m/s, with its sign."};
inline constexpr DeviceRule kEcho = {
    "echo", "It echoes a clock that the program has sent.",
    "Copy the sender's clock of the newest datagram that came, without adding to it."};
inline constexpr DeviceRule kToldAsSent = {
    "told_as_sent", "The force in the state is the one that acts on the hand then.",
    "Tell what the motors gave until this measurement, not what was last asked for."};
inline constexpr DeviceRule kNoLimits = {
    "no_limits", "The device limits force, and its change, below the program.",
    "Limit each point to the most of the welcome and its change to 2000 N/s, in the device."};
inline constexpr DeviceRule kReplay = {"replay", "A command that is said again counts once.",
                                       "Drop a datagram whose number came before."};
inline constexpr DeviceRule kSilence = {
    "silence", "Without commands there is no force, within the time of the welcome.",
    "Give no force when no new command has come for 20 ms, and tell armed 0."};
inline constexpr DeviceRule kRearms = {
    "rearms", "After a fault it gives no force until it is armed by another number.",
    "Keep armed 0 until a command with another arm_number and without force."};
inline constexpr DeviceRule kHalt = {"halt",
                                     "A halt ends the force at once, until another arming.",
                                     "Take halts on the stream like commands that disarm."};
inline constexpr DeviceRule kBusy = {
    "busy", "While a program is connected another one is refused for reason 1.",
    "Serve one program at a time."};
inline constexpr DeviceRule kGoodbye = {
    "goodbye", "After a goodbye the next program finds no force and no arming.",
    "Forget the arming and the command with the program that leaves."};
inline constexpr DeviceRule kGone = {
    "gone", "A program that died is forgotten after a second of silence.",
    "Count the time since the last datagram of the client, and let another one in."};

}  // namespace jnd::device
