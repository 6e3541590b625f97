using System;

namespace LagSim.Tests.Faults;

/// <summary>Ways to heal that are known to be wrong: negative controls, which <see cref="FaultyEngineParts"/> puts in.</summary>
[Flags]
internal enum HealingFault
{
    /// <summary>Heals right.</summary>
    None = 0,

    /// <summary>A new path is tested against the newest segments of others, not against those that held at the time.</summary>
    ForgetsThePast = 1,

    /// <summary>Of a body that was rewound, but to later than the current event, only the newest segment is tested.</summary>
    OverlooksBodiesAhead = 2,

    /// <summary>
    /// A pending contact is dropped when its partner has another newest segment, although the one that the contact was found with still
    /// stands.
    /// </summary>
    GivesUpByBody = 4,

    /// <summary>External events of bodies that a heal rewinds along with others are not applied again.</summary>
    DropsEvents = 8,

    /// <summary>Timelines are cut at the time of a key, not at the key.</summary>
    CutsByTime = 16,

    /// <summary>A late event leaves a body where it is that has come to rest meanwhile.</summary>
    LeavesWhoRests = 32,

    /// <summary>A heal ends where the bodies are in their old places again, whichever way they move.</summary>
    StopsWherePlacesMeet = 64,

    /// <summary>A late event on a member of an island leaves those asleep that lie on it.</summary>
    LeavesSleepers = 128,

    /// <summary>The segments that one contact step, or one impact on an island, opens are not cut together.</summary>
    CutsMembersAlone = 256,

    /// <summary>The near misses of a step are forgotten.</summary>
    ForgetsNearMisses = 512,

    /// <summary>
    /// A heal ends where the members of an island are on their old segments again, whatever they carry: instants, contacts and impulses.
    /// </summary>
    StopsWhereChordsMeet = 1024,

    /// <summary>What has happened of an instant, of which the rest has not, stays when an earlier event comes.</summary>
    LeavesPartOfAnInstant = 2048,

    /// <summary>
    /// A collapse takes in every body that touches, also those that nothing struck in this instant. A heal that brings such a body into
    /// touch then does not notice that it has to solve the collapse again.
    /// </summary>
    CollapsesWithWhoTouches = 4096,

    /// <summary>
    /// A body that moves on ahead of the others in a heal is taken out of the index's lists for them, though they still have to meet
    /// it where it was.
    /// </summary>
    ForgetsBodiesMovedOn = 8192,

    /// <summary>A heal ends where the bodies are on their old segments again, whatever they collide with there.</summary>
    IgnoresFilters = 16384,

    /// <summary>Crossings of sensors are not cut with the paths on which they were found.</summary>
    LeavesCrossings = 32768,

    /// <summary>Where paths have reconverged, the crossings that were cut are not put back with them.</summary>
    PutsNoCrossingsBack = 65536,

    /// <summary>Whether a spawn or a teleport finds its place free is not asked again where a heal changes who is there.</summary>
    LeavesPlacings = 131072,

    /// <summary>Crossings of a sensor that a body carries are not cut with that body's path.</summary>
    LeavesCarried = 262144,

    /// <summary>Those stay that were struck with a body, and again in that instant, when the body is cut between the two.</summary>
    LeavesStruckAgain = 524288,

    /// <summary>A path is tested against where others are after the current impact, not before the first of its round.</summary>
    ForgetsTheRound = 1048576,

    /// <summary>What is done to a body stays as it is when one that lies on it, and was awake, is asleep again.</summary>
    LeavesWhatWakes = 2097152,
}
