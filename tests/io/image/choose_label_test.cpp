#include "condyle/io/label_file.hpp"
#include "io/image/label_files.hpp"
#include "support/test.hpp"

namespace condyle {
namespace {

test::LabelImage labelled_image(std::size_t layers = 1) {
  return test::label_image(Eigen::Affine3d::Identity(), layers);
}

/// With names as TotalSegmentator writes them.
io::LabelMap named_by_nifti(const std::string& labels) {
  const std::string xml =
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?> <CaretExtension>\n"
      "<Date><![CDATA[2013-07-14T05:45:09]]></Date>\n<VolumeInformation Index=\"0\">\n<LabelTable>\n" +
      labels +
      "</LabelTable>\n<StudyMetaDataLinkSet></StudyMetaDataLinkSet>\n"
      "<VolumeType><![CDATA[Label]]></VolumeType>\n</VolumeInformation></CaretExtension>";
  const std::string extensions =
      std::string("\1\0\0\0", 4) + test::nifti_extension(6, "a comment") + test::nifti_extension(0, xml);
  return io::read_labels(test::nifti(labelled_image(), {.extensions = extensions}), io::LabelFormat::nifti,
                         "bones");
}

io::LabelMap named_by_slicer(const std::string& lines, std::size_t layers) {
  return io::read_labels(test::nrrd(labelled_image(layers), {.more_lines = lines}), io::LabelFormat::nrrd,
                         "bones");
}

io::LabelMap without_names() {
  return io::read_labels(test::nifti(labelled_image()), io::LabelFormat::nifti, "bones");
}

const std::string femurs =
    "<Label Key=\"75\" Red=\"0.1\" Green=\"0.2\" Blue=\"0.3\" Alpha=\"1\"><![CDATA[femur_left]]></Label>\n"
    "<Label Key=\"76\" Red=\"0.1\" Green=\"0.2\" Blue=\"0.3\" Alpha=\"1\"><![CDATA[femur_right]]></Label>\n";

/// "layer:label name", or the error.
std::string chosen(const io::LabelMap& map, std::string_view text, std::optional<io::LabelTask> task = {}) {
  try {
    const auto choice = io::choose_label(map, text, task);
    return std::to_string(choice.layer) + ":" + std::to_string(choice.label) + " " + choice.name;
  } catch (const UsageError& error) {
    return error.what();
  }
}

TEST(CaretNames, AreRead) {
  const auto map = named_by_nifti(femurs);
  ASSERT_EQ(map.segments.size(), 2u);
  EXPECT_EQ(map.segments[1].name, "femur_right");
  EXPECT_EQ(map.segments[1].label, 76u);
  EXPECT_EQ(map.segments[1].layer, 0u);
}

TEST(CaretNames, MayHoldAnyCharacter) {
  const auto map = named_by_nifti(
      "<Label Key=\"1\"><![CDATA[a < b > c & ]] d]]></Label><Label Key=\"2\">a &lt; b &amp;amp; c</Label>"
      "<Label Key=\"3\"> <![CDATA[bl\x1b[31mank]]> </Label><Label Key=\"75\"/><Label Key='76'></Label>");
  ASSERT_EQ(map.segments.size(), 5u);
  EXPECT_EQ(map.segments[0].name, "a < b > c & ]] d");
  EXPECT_EQ(map.segments[1].name, "a < b &amp; c");
  EXPECT_EQ(map.segments[2].name, "bl [31mank");
  EXPECT_EQ(map.segments[3].name, "");
  EXPECT_EQ(map.segments[4].name, "");
}

TEST(SlicerSegments, AreByLayerAndValue) {
  const auto map = named_by_slicer(
      "Segment0_ID:=Segment_1\nSegment0_LabelValue:=3\nSegment0_Layer:=0\nSegment0_Name:=Left femur\n"
      "Segment0_Extent:=0 4 0 3 0 2\nSegment10_Name:=Pelvis \\\\ both\nSegment10_LabelValue:=3\n"
      "Segment10_Layer:=1\nSegment2_Name:=Sacrum\nSegment2_LabelValue:=75\nSegment2_Layer:=1\n"
      "Segmentation_ReferenceImageExtentOffset:=-3 0 2\nSegmentation_MasterRepresentation:=Binary labelmap\n",
      2);
  ASSERT_EQ(map.segments.size(), 3u);
  EXPECT_EQ(map.segments[2].name, "Pelvis \\ both");
  EXPECT_EQ(chosen(map, "Left femur"), "0:3 Left femur");
  EXPECT_EQ(chosen(map, "Segment_1"), "0:3 Left femur");
  EXPECT_EQ(chosen(map, "Sacrum"), "1:75 Sacrum");
  EXPECT_EQ(chosen(map, "Pelvis \\ both"), "1:3 Pelvis \\ both");
  EXPECT_EQ(chosen(map, "3"), "the label 3 is in several layers: choose one of 0:3, 1:3");
  EXPECT_EQ(chosen(map, "1:3"), "1:3 Pelvis \\ both");
  EXPECT_EQ(chosen(map, "2:3"), "no layer 2: the image has 2, counted from 0");
}

TEST(SlicerSegments, AreOneLayerEachInOldFiles) {
  const auto map = named_by_slicer("Segment0_Name:=a\nSegment1_Name:=b\n", 2);
  ASSERT_EQ(map.segments.size(), 2u);
  EXPECT_EQ(map.segments[1].layer, 1u);
  EXPECT_EQ(map.segments[1].label, 1u);
}

TEST(ChosenLabels, ByNameAreExactFirstAndThenWithoutCaseAndBlanks) {
  const auto map = named_by_nifti("<Label Key=\"3\">Femur Right</Label>" + femurs);
  EXPECT_EQ(chosen(map, "Femur Right"), "0:3 Femur Right");
  EXPECT_EQ(chosen(map, "femur_right"), "0:76 femur_right");
  EXPECT_EQ(chosen(map, "FEMUR LEFT"), "0:75 femur_left");
  EXPECT_EQ(chosen(map, "Femur_Right"),
            "'Femur_Right' is the name of several labels: choose one of 0:3, 0:76");
}

TEST(ChosenLabels, AreNeverGuessedByLikeness) {
  const auto map = named_by_nifti(femurs);
  EXPECT_EQ(chosen(map, "femur_rigth"),
            "no label is called 'femur_rigth' (did you mean \"femur_right\"?): there are 'femur_left', "
            "'femur_right'");
  EXPECT_EQ(chosen(map, "femur"), "no label is called 'femur': there are 'femur_left', 'femur_right'");
  EXPECT_EQ(chosen(map, ""), "no label is called '': there are 'femur_left', 'femur_right'");
  EXPECT_EQ(
      chosen(without_names(), "femur_left"),
      "'femur_left': the file names no labels: choose a number, or say of which task the names are; the "
      "image holds 3, 75, 76, 120");
}

TEST(ChosenLabels, ByTheNamesOfATask) {
  const auto map = without_names();
  EXPECT_EQ(chosen(map, "femur_left", io::LabelTask::total), "0:75 femur_left");
  EXPECT_EQ(chosen(map, "Femur Right", io::LabelTask::total), "0:76 femur_right");
  EXPECT_EQ(chosen(map, "femur_left", io::LabelTask::total_v1),
            "no voxel has the label 88: the image holds 3, 75, 76, 120");
  test::expect_begins(chosen(map, "femur_lef", io::LabelTask::total_mr),
                      "no label is called 'femur_lef' (did");
  EXPECT_TRUE(io::choose_label(map, "femur_left", io::LabelTask::total).notes.empty());
}

TEST(ChosenLabels, MustNotContradictTheFile) {
  const auto map = named_by_nifti("<Label Key=\"75\">tibia</Label><Label Key=\"3\">femur_right</Label>");
  EXPECT_EQ(chosen(map, "femur_left", io::LabelTask::total),
            "femur_left is 75 in TotalSegmentator's total, which the file calls 'tibia'");
  EXPECT_EQ(chosen(map, "femur_right", io::LabelTask::total),
            "'femur_right' is 76 in TotalSegmentator's total, but 3 in the file");
  EXPECT_EQ(chosen(map, "femur_right"), "0:3 femur_right");
}

TEST(ChosenLabels, ByNumberAreTakenAsGivenAndNoted) {
  const auto choice = io::choose_label(named_by_nifti(femurs), "75");
  EXPECT_EQ(choice.name, "femur_left");
  ASSERT_EQ(choice.notes.size(), 1u);
  EXPECT_EQ(choice.notes[0].code, io::LabelNoteCode::label_tables);
  EXPECT_EQ(choice.notes[0].text,
            "Label 75 is taken as given: it is 'femur_left' in the file, femur_left in TotalSegmentator's "
            "total.");
  EXPECT_EQ(io::choose_label(without_names(), "3").notes[0].text,
            "Label 3 is taken as given: neither the file nor a known table names it.");
  EXPECT_EQ(chosen(without_names(), "90"), "no voxel has the label 90: the image holds 3, 75, 76, 120");
  test::expect_begins(chosen(without_names(), "-3"), "'-3': the file names no labels");
}

TEST(ChosenLabels, ANumberOfVersion1IsSomethingElseInVersion2) {
  const test::LabelImage brain{{2, 1, 1}, Eigen::Affine3d::Identity(), {{0, 90}}};
  const auto map = io::read_labels(test::nifti(brain), io::LabelFormat::nifti, "bones");
  EXPECT_EQ(io::choose_label(map, "90").notes[0].text,
            "Label 90 is taken as given: it is brain in TotalSegmentator's total, hip_left in "
            "TotalSegmentator's total_v1.");
}

TEST(ChosenLabels, ANumberThatIsAnotherLabelsNameIsRefused) {
  const auto map = named_by_nifti("<Label Key=\"3\">75</Label>");
  EXPECT_EQ(chosen(map, "75"),
            "'75' is a number and also the name of the label 0:3: give its layer and label instead");
  EXPECT_EQ(chosen(map, "0:75"), "0:75 ");
  EXPECT_EQ(chosen(map, "3"), "0:3 75");
}

TEST(LabelTasks, AreReadByName) {
  for (const auto task : {io::LabelTask::total, io::LabelTask::total_v1, io::LabelTask::total_mr})
    EXPECT_EQ(io::label_task_of(name_of(task)), task);
  EXPECT_EQ(io::label_task_of("Total"), std::nullopt);
}

TEST(SeveralLabels, AreOneBone) {
  const io::LabelMap map = without_names();
  const auto voxels = [](const VoxelMask& mask) {
    return std::count(mask.inside.begin(), mask.inside.end(), std::uint8_t{1});
  };
  std::vector<std::uint32_t> labels;
  for (const std::uint32_t label : map.labels)
    if (label != 0) labels.push_back(label);
  ASSERT_GE(labels.size(), 2u);
  const std::string a = std::to_string(labels[0]), b = std::to_string(labels[1]);
  const io::ChosenLabel both = io::choose_label(map, a + "," + b);
  ASSERT_EQ(both.also.size(), 1u);
  EXPECT_EQ(voxels(io::mask_of(map, both)),
            voxels(io::mask_of(map, 0, labels[0])) + voxels(io::mask_of(map, 0, labels[1])));
  EXPECT_EQ(chosen(map, a + ",999"), chosen(map, "999"));
}

}  // namespace
}  // namespace condyle
