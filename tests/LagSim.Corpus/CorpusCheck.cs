using System;
using System.Diagnostics;
using System.Globalization;
using System.IO;
using System.Linq;
using System.Reflection;
using System.Runtime.CompilerServices;
using System.Runtime.InteropServices;
using LagSim.Net.Recordings;
using LagSim.Net.Sessions;
using LagSim.Scenes;

namespace LagSim.Corpus;

/// <summary>Replays recordings and says of each whether this runtime gives the hashes that stand in it.</summary>
public static class CorpusCheck
{
    /// <summary>The accelerations that recordings of the corpus may use: of a recording's scene only the name travels, not the code.</summary>
    public static IAcceleration[] Known => [new DragAndSpring(), new Eddy()];

    /// <summary>Replays every recording of a folder, by name.</summary>
    /// <param name="folder">Where the recordings are.</param>
    /// <param name="output">
    /// Gets the runtime, a line for each recording (<c>ok NAME HASH</c>, <c>DIFFERS NAME EXPECTED ACTUAL</c> at the first committed state that
    /// differs, or <c>CANNOT NAME</c> and why), and <c>N agree, N differ</c>.
    /// </param>
    /// <returns>0 when all agree and there is at least one, else 1.</returns>
    /// <exception cref="IOException">The folder or a file cannot be read.</exception>
    public static int Run(string folder, TextWriter output)
    {
        output.WriteLine(Runtime());
        string[] files = Directory.GetFiles(folder, "*" + RecordingFormat.Extension);
        Array.Sort(files, StringComparer.Ordinal);
        int agree = 0;
        foreach (string file in files)
        {
            string verdict = Verdict(Recording.Read(file, Known), Path.GetFileNameWithoutExtension(file), out bool agrees);
            output.WriteLine(verdict);
            agree += agrees ? 1 : 0;
        }

        string transcript = Path.Combine(folder, SecureTranscript.FileName);
        int all = files.Length;
        if (File.Exists(transcript))
        {
            bool isSame = File.ReadAllLines(transcript).SequenceEqual(SecureTranscript.Lines());
            output.WriteLine(isSame ? "ok handshake" : "DIFFERS handshake");
            all++;
            agree += isSame ? 1 : 0;
        }

        output.WriteLine(FormattableString.Invariant($"{agree} agree, {all - agree} differ"));
        return agree > 0 && agree == all ? 0 : 1;
    }

    /// <summary>Which runtime this is, on which processor, and which builds of the library it runs.</summary>
    public static string Runtime()
    {
        string name = Type.GetType("Mono.Runtime") is not null ? "Mono"
            : RuntimeInformation.ProcessArchitecture.ToString() == "Wasm" ? "WebAssembly" // an enum of netstandard2.1 does not know it
            : !RuntimeFeature.IsDynamicCodeSupported ? "NativeAOT"
            : "CoreCLR";
        string version = RuntimeInformation.FrameworkDescription.Split('(')[0].Trim();
        string world = Build(typeof(Simulation)), net = Build(typeof(Recording));
        return $"{name} {RuntimeInformation.ProcessArchitecture} ({version}), library {(world == net ? world : $"{world} and {net}")}";
    }

    /// <summary>Runs one recording again. Of one that is not whole what it holds may well agree; that is not enough here.</summary>
    private static string Verdict(Recording recording, string name, out bool agrees)
    {
        agrees = false;
        if (!recording.IsWhole)
        {
            return $"CANNOT {name} It {recording.Extent}";
        }

        RecordingReplay replay = RecordingReplay.Run(recording);
        switch (replay.Outcome)
        {
            case ReplayOutcome.Agrees:
                agrees = true;
                return $"ok {name} {Hash(replay.Actual)}";
            case ReplayOutcome.Differs:
                return $"DIFFERS {name} {Hash(replay.Expected)} {Hash(replay.Actual)}";
            default:
                return $"CANNOT {name} {replay.Message}";
        }
    }

    /// <summary>State and events as one word; the last or the first that differs.</summary>
    private static string Hash(CommittedState? state) => state is CommittedState s
        ? string.Format(CultureInfo.InvariantCulture, "{0:x16}-{1:x16}", s.StateHash, s.EventHash)
        : "none";

    private static string Build(Type type)
    {
        Assembly assembly = type.Assembly;
        bool isDebug = assembly.GetCustomAttribute<DebuggableAttribute>()?.IsJITOptimizerDisabled == true;
        string target = assembly.GetCustomAttributes<System.Runtime.Versioning.TargetFrameworkAttribute>().Single().FrameworkName;
        return $"{(isDebug ? "Debug" : "Release")} {(target.StartsWith(".NETStandard", StringComparison.Ordinal) ? "netstandard" : "net")}{target.Split('v')[1]}";
    }
}
